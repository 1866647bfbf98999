#include "app/program.hpp"
#include "opensim/model_texts.hpp"

#include <gracilis/io/tables/table.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {

static ProgramResult sampled(const TestFolder& folder, const std::string& options) {
  const auto model = folder.write("tiny.osim", opensim::pendulum());
  return run_program("motions " + model.string() + " --out " + (folder.path() / "motions").string() + " " + options);
}

TEST(MotionsCommand, an_angle_goes_through_its_range_at_its_speed_and_time_step) {
  const TestFolder folder;
  const ProgramResult result = sampled(folder, "--range swing=-10:40 --steps 1 --speed 60 --time-step 0.02");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Table table = read_table(folder.path() / "motions/hinge_swing.mot");
  const auto column = column_of(table, "swing");
  ASSERT_TRUE(column.has_value());
  const Eigen::VectorXd angle = table.values.col(*column) * (table.in_degrees ? 1 : degrees(1));
  EXPECT_NEAR(angle[0], -10, 1e-9);
  EXPECT_NEAR(angle[angle.size() - 1], 40, 1e-9);
  EXPECT_NEAR(table.times[1] - table.times[0], 0.02, 1e-9);
  Real fastest = 0;
  for (Eigen::Index i = 1; i < angle.size(); ++i) fastest = std::max(fastest, (angle[i] - angle[i - 1]) / 0.02);
  EXPECT_LE(fastest, 60 + 1e-6);
  EXPECT_GT(fastest, 55);
}

TEST(MotionsCommand, wrong_ranges_are_named) {
  const TestFolder folder;
  EXPECT_THAT(sampled(folder, "--range swim=-10:40").err, testing::HasSubstr("did you mean 'swing'?"));
  EXPECT_EQ(sampled(folder, "--range swing=-10").exit_code, 2);
  EXPECT_EQ(sampled(folder, "--combined spiral").exit_code, 2);
  EXPECT_THAT(sampled(folder, "--speed 0.001 --time-step 0.00001").err, testing::HasSubstr("more than a million rows"));
}

TEST(MotionsCommand, ranges_that_would_be_passed_over_are_refused_with_the_reason) {
  using namespace opensim;
  const TestFolder folder;
  const std::string locked =
      "<Coordinate name=\"twist\"><default_value>0</default_value><locked>true</locked></Coordinate>";
  const auto model = folder.write(
      "leg.osim",
      document(set("BodySet", body("thigh") + body("shank") + body("foot")) +
               set("JointSet", joint("PinJoint", "hip_r", "/ground", "thigh", coordinate("hip_flexion_r")) +
                                   joint("PinJoint", "knee_r", "/bodyset/thigh", "shank", coordinate("knee_angle_r")) +
                                   joint("PinJoint", "ankle_r", "/bodyset/shank", "foot", locked))));
  const auto motions = [&](const std::string& options) {
    return run_program("motions " + model.string() + " --steps 1 --out " + (folder.path() / "out").string() + " " +
                       options);
  };
  const ProgramResult other = motions("--joint hip_r --range knee_angle_r=-20:0");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, testing::HasSubstr("'knee_angle_r' is a coordinate of the joint 'knee_r'"));
  EXPECT_EQ(motions("--joint hip_r --joint knee_r --range knee_angle_r=-20:0").exit_code, 0);
  for (const std::string range : {"nan:10", "0:inf"}) {
    const ProgramResult result = motions("--range hip_flexion_r=" + range);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, testing::HasSubstr("--range: 'hip_flexion_r=" + range + "' is no range"));
  }
  const ProgramResult held = motions("--range twist=0:10");
  EXPECT_EQ(held.exit_code, 2);
  EXPECT_THAT(held.err, testing::HasSubstr("'twist' is locked"));
}

}  // namespace gracilis
