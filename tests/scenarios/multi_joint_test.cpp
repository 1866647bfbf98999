#include "chains.hpp"
#include "scenario_runs.hpp"

#include <gracilis/scene/validate.hpp>

#include <moved_scenes.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

/// Muscles over several joints, and muscles whose ends are anywhere: every gate holds, and they come back.
namespace gracilis {
namespace {

using namespace chains;
constexpr AttachmentEnd origin = AttachmentEnd::origin, insertion = AttachmentEnd::insertion;
constexpr Real before = -0.024, behind = 0.024;  ///< m, along x: a millimetre or two clear of the bones

const std::vector<Hold> thigh_to_foot = {{origin, 0, 0.53, 0.55}, {insertion, 2, -0.05, -0.03}};

Muscle over_two_joints(Real x) { return spindle("over_two_joints", 0.55, -0.05, x, thigh_to_foot); }

Scene with(Scene scene, std::vector<Muscle> muscles) {
  scene.muscles = std::move(muscles);
  return scene;
}

void expect_gates_and_return(const Scene& scene) {
  ASSERT_THAT(validate(scene), testing::IsEmpty());
  const WholeRun run = run_whole(scene);
  expect_gates(scene, run);
  expect_return(scene, run);
}

Frame end_of(const Scene& scene) {
  Frame end;
  run_whole(scene, 1, [&](const FrameRecord& record) { end = record.frame; });
  return end;
}

}  // namespace

TEST(MultiJoint, both_joints_flexed_there_and_back) {
  expect_gates_and_return(moving(with(three_shafts(), {over_two_joints(before)}), {100, 100}, true));
}

TEST(MultiJoint, drawn_around_both_joints_there_and_back) {
  expect_gates_and_return(moving(with(three_shafts(), {over_two_joints(behind)}), {90, 90}, true));
}

TEST(MultiJoint, one_joint_flexed_and_the_other_extended_in_large_steps) {
  expect_gates_and_return(moving(with(three_shafts(), {over_two_joints(before)}), {100, -100}, true, 10));
}

TEST(MultiJoint, twisted_against_each_other) {
  Scene scene = with(three_shafts(), {over_two_joints(before)});
  for (Joint& joint : scene.joints) joint.axes[0].axis = Vec3::UnitZ();
  expect_gates_and_return(moving(scene, {80, -80}, true));
}

TEST(MultiJoint, three_joints_in_a_zigzag) {
  Scene scene = three_shafts();
  scene.bodies.push_back("toe");
  scene.bones.push_back({"toe", 3, shaft(-0.11, -0.2)});
  scene.joints.push_back(hinge("toes", 2, 3, {0, 0, -0.105}));
  scene.muscles = {spindle("over_three", 0.55, -0.15, before, {{origin, 0, 0.53, 0.55}, {insertion, 3, -0.15, -0.13}})};
  expect_gates_and_return(moving(scene, {50, -40, 50}, true));
}

TEST(MultiJoint, muscles_before_and_behind_two_joints_and_one_over_them) {
  Muscle back = over_two_joints(behind);
  back.name = "back";
  const Muscle over = spindle("over", 0.5, 0.2, -0.05, {{origin, 0, 0.48, 0.5}, {insertion, 1, 0.2, 0.22}});
  expect_gates_and_return(moving(with(three_shafts(), {over_two_joints(before), back, over}), {70, -50}, true));
}

TEST(MultiJoint, an_active_muscle_over_two_joints) {
  Scene scene = moving(with(three_shafts(), {over_two_joints(before)}), {60, 60});
  scene.activation.signals = {{"over_two_joints", {0}, {0.3}}};
  expect_gates(scene, run_whole(scene));
}

TEST(MultiJoint, kilometres_away_and_turned_over) {
  const RigidTransform by =
      Eigen::Translation3d(5000.3, -3000.7, 8000.1) * Eigen::AngleAxisd(2.4, Vec3(1, -2, 2).normalized());
  expect_gates_and_return(moved(by, moving(with(three_shafts(), {over_two_joints(before)}), {60, 60}, true)));
}

TEST(MuscleEnds, both_on_one_body_go_where_it_goes) {
  const Muscle own = spindle("own", 0.25, 0.05, before, {{origin, 1, 0.23, 0.25}, {insertion, 1, 0.05, 0.07}});
  const Scene scene = moving(with(three_shafts(), {own}), {90, 60});
  const Frame end = end_of(scene);
  EXPECT_LT((end.muscles[0].points - moved(end.pose.bodies[1], own.surface.vertices)).colwise().norm().maxCoeff(),
            1e-5);
}

TEST(MuscleEnds, both_on_bodies_that_move) {
  const Muscle low = spindle("low", 0.25, -0.06, before, {{origin, 1, 0.23, 0.25}, {insertion, 2, -0.06, -0.04}});
  expect_gates_and_return(moving(with(three_shafts(), {low}), {90, 60}, true));
}

TEST(MuscleEnds, on_three_bodies) {
  for (const AttachmentEnd middle : {origin, insertion}) {
    std::vector<Hold> holds = thigh_to_foot;
    holds.push_back({middle, 1, 0.14, 0.16});
    expect_gates_and_return(
        moving(with(three_shafts(), {spindle("three", 0.55, -0.05, before, holds)}), {60, -40}, true));
  }
}

/// A kneecap where muscles are drawn around the knee, between a long muscle and a short ligament; it turns about the
/// knee by a coordinate of its own.
TEST(MuscleEnds, on_a_kneecap_that_glides) {
  Scene scene = three_shafts();
  scene.bodies.push_back("kneecap");
  TriangleMesh cap = shapes::sphere(Vec3::Zero(), 1, 3);
  for (auto p : cap.vertices.colwise()) p = p.cwiseProduct(Vec3(0.007, 0.015, 0.018)) + Vec3(0.026, 0, 0.3);
  scene.bones.push_back({"kneecap", 3, cap});
  scene.joints.push_back(hinge("kneecap", 0, 3, {0, 0, 0.3}));
  scene.muscles = {
      spindle("quadriceps", 0.55, 0.305, 0.028, {{origin, 0, 0.52, 0.55}, {insertion, 3, 0.305, 0.312}}),
      spindle("ligament", 0.295, 0.2, 0.026, {{origin, 3, 0.285, 0.295}, {insertion, 1, 0.2, 0.21}}, 0.006)};
  expect_gates_and_return(moving(scene, {90, 0, 50}, true));
}

TEST(MuscleEnds, on_a_body_without_bones) {
  Scene scene = three_shafts();
  std::erase_if(scene.bones, [](const Bone& bone) { return bone.name == "shank"; });
  scene.muscles = {spindle("low", 0.25, -0.06, before, {{origin, 1, 0.23, 0.25}, {insertion, 2, -0.06, -0.04}}),
                   spindle("high", 0.55, 0.15, behind, {{origin, 0, 0.53, 0.55}, {insertion, 1, 0.15, 0.17}})};
  expect_gates_and_return(moving(scene, {60, 60}, true));
}

TEST(MuscleEnds, without_any_bone_in_the_scene_keep_volume_and_edges) {
  Scene scene = moving(with(three_shafts(), {over_two_joints(before)}), {60, 60}, true);
  scene.bones.clear();
  const WholeRun run = run_whole(scene);
  EXPECT_LE(run.muscles[0].volume_error, 0.005);
  EXPECT_LE(run.muscles[0].free_edge_ratio, 3);
  expect_return(scene, run);
}

/// The rider's ends move with bones, but lie on the muscle between, one millimetre deep.
TEST(MuscleEnds, on_another_muscle) {
  const Muscle rider = spindle("rider", 0.5, 0.1, -0.047, {{origin, 0, 0.48, 0.5}, {insertion, 1, 0.1, 0.12}});
  expect_gates_and_return(moving(with(three_shafts(), {over_two_joints(before), rider}), {60, -30}, true));
}

/// Nothing holds it; the muscle under it pushes it about.
TEST(MuscleEnds, on_nothing_at_all_leave_a_muscle_to_its_neighbors) {
  const Muscle free = spindle("free", 0.5, 0.25, -0.05, {});
  // Contact alone moves it, by its reach a frame at most.
  const Scene scene = moving(with(three_shafts(), {over_two_joints(before), free}), {60, 0}, true, 0.5);
  ASSERT_THAT(validate(scene), testing::IsEmpty());
  expect_gates(scene, run_whole(scene));
}

}  // namespace gracilis
