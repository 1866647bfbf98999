#include "app/program.hpp"
#include "opensim/model_texts.hpp"

#include <gracilis/io/tables/table.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {

static std::string still_motion() {
  std::string text = "still\nversion=1\nnRows=8\nnColumns=2\ninDegrees=yes\nendheader\ntime\tswing\n";
  for (int i = 0; i < 8; ++i) text += std::to_string(0.1 * i) + "\t30\n";
  return text;
}

static const std::string held = opensim::pendulum(
    "<CoordinateActuator name=\"motor\"><coordinate>swing</coordinate><optimal_force>10</optimal_force>"
    "<max_control>CONTROL</max_control></CoordinateActuator>");

static ProgramResult optimize(const TestFolder& folder, const std::string& control, const std::string& more) {
  std::string text = held;
  text.replace(text.find("CONTROL"), 7, control);
  const auto model = folder.write("tiny.osim", text), motion = folder.write("still.mot", still_motion());
  return run_program("static-optimization --model " + model.string() + " --motion " + motion.string() + " --out " +
                     folder.path().string() + " " + more);
}

TEST(StaticOptimizationCommand, writes_activations_and_forces) {
  const TestFolder folder;
  const ProgramResult result = optimize(folder, "1", "--every 4 --cutoff 2");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Table activations = read_table(folder.path() / "gracilis_StaticOptimization_activation.sto");
  const Table forces = read_table(folder.path() / "gracilis_StaticOptimization_force.sto");
  ASSERT_EQ(activations.times.size(), 3u);  // rows 0, 4 and 7
  EXPECT_NEAR(activations.values(1, 0), 9.80665 * 0.5 / 10, 1e-6);
  EXPECT_NEAR(forces.values(1, 0), 9.80665 * 0.5, 1e-5);
}

TEST(StaticOptimizationCommand, weakness_is_told_and_fails_when_strict) {
  const TestFolder folder;
  const ProgramResult loose = optimize(folder, "0.1", "");
  EXPECT_EQ(loose.exit_code, 0);
  EXPECT_THAT(loose.err, testing::HasSubstr("too weak; missing (N m or N): swing 3.9"));
  EXPECT_EQ(optimize(folder, "0.1", "--strict").exit_code, 5);
}

TEST(StaticOptimizationCommand, a_model_and_a_motion_are_needed) {
  const ProgramResult result = run_program("static-optimization --out /tmp");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, testing::HasSubstr("give a set-up file, or --model and --motion"));
}

TEST(StaticOptimizationCommand, joint_loads_come_with_it_or_of_known_forces) {
  const TestFolder folder;
  ASSERT_EQ(optimize(folder, "1", "--reactions ALL").exit_code, 0);
  const auto file = folder.path() / "gracilis_JointReaction_ReactionLoads.sto";
  const Table loads = read_table(file);
  ASSERT_EQ(loads.columns.size(), 9u);
  EXPECT_NEAR(loads.values(3, 1), 2 * 9.80665, 1e-6);  // the rod's weight
  std::filesystem::remove(file);
  const auto forces = folder.path() / "gracilis_StaticOptimization_force.sto";
  const ProgramResult known = optimize(folder, "1", "--on parent --reactions hinge --known-forces " + forces.string());
  ASSERT_EQ(known.exit_code, 0) << known.err;
  EXPECT_NEAR(read_table(file).values(3, 1), -2 * 9.80665, 1e-6);
  EXPECT_EQ(optimize(folder, "1", "--reactions hing").exit_code, 3);
}

TEST(StaticOptimizationCommand, forces_that_take_no_part_are_named_last) {
  const TestFolder folder;
  std::string text = held;
  text.replace(text.find("CONTROL"), 7, "1");
  text.insert(text.find("<CoordinateActuator"), "<HuntCrossleyForce name=\"heel\"/>");
  const auto model = folder.write("tiny.osim", text), motion = folder.write("still.mot", still_motion());
  const ProgramResult result = run_program("static-optimization --model " + model.string() + " --motion " +
                                           motion.string() + " --muscles elastic --out " + folder.path().string());
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, testing::HasSubstr("1 of the model's forces took no part"));
  EXPECT_THAT(result.err, testing::HasSubstr("whole model: heel"));
}

}  // namespace gracilis
