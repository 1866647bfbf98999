#include "app/program.hpp"
#include "opensim/model_texts.hpp"

#include <gracilis/io/input_file.hpp>
#include <gracilis/io/tables/table.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {

using opensim::muscle;
using opensim::pendulum;
using opensim::point;

static const std::string tiny = pendulum(muscle("m", point("/ground", "0.3 0 0") + point("/bodyset/rod", "0 -0.4 0")));

TEST(PathsCommand, a_sweep_writes_lengths_moment_arms_and_the_coordinate) {
  const TestFolder folder;
  const auto model = folder.write("tiny.osim", tiny);
  const ProgramResult result =
      run_program("paths " + model.string() + " --coord swing=-10:20:5 --out " + (folder.path() / "out").string());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Table lengths = read_table(folder.path() / "out/tiny_MuscleAnalysis_Length.sto");
  const Table arms = read_table(folder.path() / "out/tiny_MuscleAnalysis_MomentArm_swing.sto");
  const Table coordinates = read_table(folder.path() / "out/tiny_coordinates.sto");
  ASSERT_EQ(lengths.times.size(), 7u);
  EXPECT_NEAR(coordinates.values(6, 0), 20, 1e-12);
  for (const Table* table : {&lengths, &arms}) {
    ASSERT_EQ(table->columns, (std::vector<std::string>{"swing", "m"}));
    EXPECT_NEAR(table->values(6, 0), 20, 1e-12) << "degrees";
  }
  EXPECT_NEAR(lengths.values(2, 1), 0.5, 1e-14);
  EXPECT_NEAR(arms.values(2, 1), 0.3 * 0.4 / 0.5, 1e-14);
  EXPECT_THAT(read_text(folder.path() / "out/tiny_MuscleAnalysis_Length.csv"),
              testing::StartsWith("swing_deg,m\n-10,"));
  EXPECT_THAT(read_text(folder.path() / "out/tiny_MuscleAnalysis_MomentArm_swing.csv"),
              testing::AllOf(testing::StartsWith("swing_deg,m\n-10,"), testing::HasSubstr("\n20,")));
  const std::string plot = read_text(folder.path() / "out/plots/tiny_moment_arms_about_swing.svg");
  EXPECT_THAT(plot, testing::HasSubstr("swing (degrees)"));
  EXPECT_THAT(plot, testing::HasSubstr("<polyline"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out/plots/tiny_lengths.svg"));
}

TEST(PathsCommand, lengths_are_those_of_the_arms_or_opensims_own) {
  const TestFolder folder;
  const std::string wrap =
      "<WrapObjectSet><objects><WrapCylinder name=\"w\"><radius>0.1</radius><length>9</length><quadrant>+x</quadrant>"
      "</WrapCylinder></objects></WrapObjectSet>";
  const auto model = folder.write(
      "tiny.osim", pendulum(muscle("m", point("/ground", "0.15 0 -0.3") + point("/bodyset/rod", "0.05 -0.2 0.4"), "",
                                   "<PathWrap name=\"p\"><wrap_object>w</wrap_object></PathWrap>"),
                            wrap));
  const auto length = [&](const std::string& more, std::string& err) {
    const ProgramResult result =
        run_program("paths " + model.string() + " --coord swing=-80:-80:1 --out " + folder.path().string() + more);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    err = result.err;
    return read_table(folder.path() / "tiny_MuscleAnalysis_Length.sto").values(0, 1);
  };
  std::string of_opensim, of_way;
  const Real longer = length(" --lengths opensim", of_opensim) - length("", of_way);
  EXPECT_GT(longer, 1e-4);
  EXPECT_LT(longer, 5e-3);
  EXPECT_THAT(of_opensim, testing::HasSubstr("m: lengths are as OpenSim computes them"));
  EXPECT_THAT(of_opensim, testing::HasSubstr("--lengths geodesic gives these"));
  EXPECT_THAT(of_way,
              testing::HasSubstr("m: lengths are those of the way around its wraps, of which the moment arms are"));
  EXPECT_THAT(of_way, testing::HasSubstr("--lengths opensim gives that"));
}

TEST(PathsCommand, a_motion_in_degrees_is_turned_into_radians) {
  const TestFolder folder;
  const auto model = folder.write("tiny.osim", tiny);
  const auto motion = folder.write("m.mot",
                                   "m\nversion=1\nnRows=2\nnColumns=2\ninDegrees=yes\nendheader\ntime\tswing\n"
                                   "0\t0\n1\t90\n");
  const ProgramResult result = run_program("paths " + model.string() + " --motion " + motion.string() +
                                           " --prefix p --out " + folder.path().string());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NEAR(read_table(folder.path() / "p_MuscleAnalysis_Length.sto").values(1, 0), 0.1, 1e-14);
}

TEST(PathsCommand, what_is_not_supported_is_named_and_fails_when_strict) {
  const TestFolder folder;
  const auto model = folder.write(
      "tiny.osim",
      pendulum("<BushingForce name=\"bush\"/>" + muscle("m", point("/ground", "1 0 0") + point("rod", "0 -1 0"))));
  const std::string arguments = "paths " + model.string() + " --coord swing=0:1:1 --out " + folder.path().string();
  const ProgramResult loose = run_program(arguments);
  EXPECT_EQ(loose.exit_code, 0);
  EXPECT_THAT(loose.err, testing::HasSubstr("not supported: BushingForce 'bush'"));
  EXPECT_EQ(run_program(arguments + " --strict").exit_code, 4);
}

TEST(PathsCommand, a_wrong_coordinate_is_a_usage_error_with_a_suggestion) {
  const TestFolder folder;
  const auto model = folder.write("tiny.osim", tiny);
  const ProgramResult result =
      run_program("paths " + model.string() + " --coord swim=0:1:1 --out " + folder.path().string());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, testing::HasSubstr("did you mean 'swing'?"));
}

TEST(PathsCommand, a_sweep_that_does_not_end_is_no_sweep) {
  const TestFolder folder;
  const auto model = folder.write("tiny.osim", tiny);
  for (const std::string sweep : {"nan:1:1", "0:nan:1", "0:inf:1", "0:1:inf", "0:1:nan"}) {
    const ProgramResult result =
        run_program("paths " + model.string() + " --coord swing=" + sweep + " --out " + folder.path().string());
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, testing::HasSubstr("'swing=" + sweep + "' is no sweep"));
  }
}

}  // namespace gracilis
