#include "string_scenes.hpp"

#include <gracilis/anatomy/joints/joint_twists.hpp>
#include <gracilis/strings/cross_sections.hpp>
#include <gracilis/strings/lane_relaxation.hpp>
#include <gracilis/strings/node_relaxation.hpp>
#include <gracilis/strings/relaxation.hpp>
#include <gracilis/strings/section_lanes-inl.hpp>
#include <gracilis/strings/string_arms.hpp>

#include <gtest/gtest.h>
#include <hwy/targets.h>

namespace gracilis::strings {
namespace {

constexpr Relaxation until_rest{200, 1e-9};

StringSettings with_strings(int count) {
  StringSettings settings;
  settings.count = count;
  return settings;
}

struct Reached {
  Points by_lanes, by_nodes;
};

/// The arm's strings at an angle, relaxed from where its bodies carry them.
Reached at_angle(const Strung& arm, const MuscleStrings& muscle, Real angle) {
  const Pose pose = flexed(arm.scene, angle);
  const StringState capture = capture_state(muscle, arm.scene.bodies.size());
  LanePlaces places = lane_places(muscle.lanes, capture.places);
  carry_lanes(muscle.lanes, capture.bodies, pose.bodies, places);
  Reached reached;
  reached.by_nodes = places_of(muscle.lanes, places);
  NodeForces forces(muscle, arm.bones, pose.bodies);
  relax_nodes(forces, until_rest, reached.by_nodes);
  relax_lanes(muscle, arm.bones, pose.bodies, until_rest, places);
  reached.by_lanes = places_of(muscle.lanes, places);
  return reached;
}

TEST(LaneRelaxation, a_string_per_lane_comes_where_one_after_the_other_does) {
  const Strung arm(arm_scene());
  for (const int count : {1, 5, 17, 48}) {
    const MuscleStrings muscle = *muscle_strings(arm.scene, arm.scene.muscles[0], arm.bones, with_strings(count));
    for (const Real degrees : {2.0, 15.0, 30.0}) {
      const Reached reached = at_angle(arm, muscle, radians(degrees));
      const Points moved = reached.by_nodes - muscle.taut;
      ASSERT_GT(moved.colwise().norm().maxCoeff(), 5e-4) << "nothing to compare";
      const Eigen::RowVectorXd away = (reached.by_lanes - reached.by_nodes).colwise().norm();
      EXPECT_LT(away.mean(), 2e-6) << count << " strings at " << degrees;
      EXPECT_LT(away.maxCoeff(), 5e-5) << count << " strings at " << degrees;
    }
  }
}

TEST(LaneRelaxation, shapes_and_arms_have_the_same_bits_in_wide_and_in_narrow_registers) {
  const Strung arm(arm_scene());
  struct Found {
    Points places;
    FiberActions actions;
  };
  const auto found = [&] {
    StringState state = capture_state(arm.muscle, 2);
    for (const Real degrees : {3.0, 6.0, 9.0})
      follow(arm.muscle, arm.bones, flexed(arm.scene, radians(degrees)), state);
    const std::vector<std::vector<Twist>> twists = joint_twists(arm.scene, std::vector<Real>{radians(9.0)});
    return Found{state.places, string_actions(arm.muscle, arm.bones, state, twists, true)};
  };
  const std::int64_t targets = hwy::SupportedTargets();
  if ((targets & HWY_AVX3) == 0) GTEST_SKIP() << "this processor has no registers of 512 bits";
  const Found wide = found();
  hwy::SetSupportedTargetsForTest(targets & ~std::int64_t{HWY_AVX3});
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  const Found narrow = found();
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  EXPECT_EQ(wide.places, narrow.places);
  EXPECT_EQ(wide.actions.arms, narrow.actions.arms);
  EXPECT_EQ(wide.actions.wrenches, narrow.actions.wrenches);
}

TEST(LaneRelaxation, a_rigid_motion_of_all_bodies_moves_the_nodes_rigidly) {
  const Strung arm(arm_scene());
  const RigidTransform motion = Eigen::Translation3d(0.3, -0.2, 0.1) *
                                Eigen::AngleAxisd(radians(170), Vec3(1, 2, 3).normalized()) *
                                RigidTransform::Identity();
  Pose pose = capture_pose(2);
  pose.bodies = {motion, motion};
  StringState state = capture_state(arm.muscle, 2);
  follow(arm.muscle, arm.bones, pose, state);
  const Points expected = motion * arm.muscle.taut.colwise().homogeneous();
  EXPECT_LT((state.places - expected).colwise().norm().maxCoeff(), 1e-9);
}

TEST(LaneRelaxation, the_capture_pose_is_at_rest) {
  const Strung arm(arm_scene());
  StringState state = capture_state(arm.muscle, 2);
  for (int frame = 0; frame < 10; ++frame) follow(arm.muscle, arm.bones, capture_pose(2), state);
  EXPECT_LT((state.places - arm.muscle.taut).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(LaneRelaxation, a_bundle_that_nothing_but_its_ends_holds_is_back_within_a_few_iterations) {
  constexpr Real off_bones = -0.06, away = 0.005;
  Scene scene = arm_scene();
  scene.muscles[0].surface.vertices.row(0).array() += off_bones;
  const Strung loose(std::move(scene));
  ASSERT_EQ(loose.muscle.ties.maxCoeff(), 0);
  Points moved = loose.muscle.taut;
  for (Index s = 0; s < loose.muscle.strings; ++s)
    for (Index i = 1; i + 1 < loose.muscle.nodes; ++i)
      if (body_holding(loose.muscle, s, i) < 0) moved(1, loose.muscle.node(s, i)) += away;
  LanePlaces places = lane_places(loose.muscle.lanes, moved);
  relax_lanes(loose.muscle, loose.bones, capture_pose(2).bodies, {loose.muscle.settings.iterations, 1e-9}, places);
  const Points back = places_of(loose.muscle.lanes, places);
  EXPECT_LT((back - loose.muscle.taut).colwise().norm().mean(), 5e-5);
}

TEST(LaneRelaxation, nodes_survive_the_way_into_lanes_and_back) {
  const Strung arm(arm_scene());
  const Points back = places_of(arm.muscle.lanes, lane_places(arm.muscle.lanes, arm.muscle.taut));
  EXPECT_EQ((back - arm.muscle.taut).cwiseAbs().maxCoeff(), 0);
}

TEST(LaneRelaxation, sections_in_lanes_turn_as_the_nearest_rotation_does) {
  namespace lanes = HWY_NAMESPACE;
  const auto all = [](const Eigen::Matrix3f& m) {
    lanes::MatrixLanes rows;
    for (int i = 0; i < 3; ++i)
      rows.row[i] = {lanes::lanes_of(m(i, 0)), lanes::lanes_of(m(i, 1)), lanes::lanes_of(m(i, 2))};
    return rows;
  };
  std::srand(5);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.1 * (trial % 12), Vec3::Random().normalized()).toRotationMatrix();
    // A flat section: nothing across one of its axes.
    Eigen::Matrix3d stretch = Vec3(1, 0.7, trial % 2 ? 0.0 : 0.3).asDiagonal();
    const Eigen::Matrix3d frame = Eigen::Quaterniond::UnitRandom().toRotationMatrix();
    const Eigen::Matrix3d correlation = 1e-3 * turn * frame * stretch * frame.transpose();
    lanes::MatrixLanes found = all(Eigen::Matrix3f::Identity());
    for (int step = 0; step < 12; ++step) found = lanes::nearer_rotation(all(correlation.cast<float>()), found);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(hwy::HWY_NAMESPACE::GetLane(found.row[i].x), turn(i, 0), 2e-5) << trial;
      EXPECT_NEAR(hwy::HWY_NAMESPACE::GetLane(found.row[i].y), turn(i, 1), 2e-5) << trial;
      EXPECT_NEAR(hwy::HWY_NAMESPACE::GetLane(found.row[i].z), turn(i, 2), 2e-5) << trial;
    }
  }
}

}  // namespace
}  // namespace gracilis::strings
