#include "string_scenes.hpp"

#include <gracilis/anatomy/joints/joint_twists.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/strings/string_arms.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace gracilis::strings {
namespace {

/// The pulley's radius, m.
constexpr Real radius = 0.02;

/// A pulley that stands still, about whose axis a second body turns, and one string per given fiber from above it down
/// to that body: straight in the capture pose, wound around the pulley where the coordinate falls.
Scene pulley_scene() {
  Scene scene = arm_scene();
  constexpr Real width = 0.1;
  TriangleMesh pulley = shapes::cylinder(radius, width, 60, 20);
  for (Index v = 0; v < pulley.vertex_count(); ++v) {
    const Vec3 p = pulley.vertices.col(v);
    pulley.vertices.col(v) = Vec3(p.x(), width / 2 - p.z(), p.y());
  }
  scene.bones = {{"upper", 0, pulley}, {"lower", 1, shapes::box({-0.04, -0.01, -0.3}, {-0.03, 0.01, -0.25})}};
  scene.joints[0].axes[0] = {"turn", Vec3::UnitY(), 0, radians(-120), 0};
  Muscle& muscle = scene.muscles[0];
  muscle.surface.vertices.colwise() -= muscle.surface.vertices.rowwise().mean();
  muscle.surface.vertices.colwise() += Vec3(-0.034, 0, 0);
  for (const Real y : {-0.004, 0.0, 0.004}) {
    Points line(3, 2);
    line << -0.03, -0.03, y, y, 0.15, -0.15;
    muscle.given_fibers.append(line);
  }
  return scene;
}

/// With nothing but tension and bones.
StringSettings bare() {
  StringSettings settings;
  settings.tie_length = settings.neighbor_length = 10;
  settings.segments = 60;
  return settings;
}

FiberActions actions_at(const MuscleStrings& muscle, const Strung& strung, Real angle) {
  StringState state = capture_state(muscle, 2);
  follow(muscle, strung.bones, flexed(strung.scene, angle), state);
  return string_actions(muscle, strung.bones, state, joint_twists(strung.scene, std::vector<Real>{angle}));
}

/// -dL/dq by central differences of strings at rest, from one state.
std::vector<Real> arms_by_differences(const Strung& strung, Real angle) {
  constexpr Real step = radians(0.2);
  StringState here = capture_state(strung.muscle, 2);
  follow(strung.muscle, strung.bones, flexed(strung.scene, angle), here);
  settle(strung.muscle, strung.bones, here);
  const auto lengths = [&](Real by) {
    StringState state = here;
    follow(strung.muscle, strung.bones, flexed(strung.scene, angle + by), state);
    settle(strung.muscle, strung.bones, state);
    std::vector<Real> all;
    for (Index s = 0; s < strung.muscle.strings; ++s)
      all.push_back(polyline_length(state.places.middleCols(strung.muscle.node(s, 0), strung.muscle.nodes)));
    return all;
  };
  std::vector<Real> arms, ahead = lengths(step), behind = lengths(-step);
  for (std::size_t s = 0; s < ahead.size(); ++s) arms.push_back(-(ahead[s] - behind[s]) / (2 * step));
  return arms;
}

const Strung& pulley() {
  static const Strung strung(pulley_scene());
  return strung;
}
const MuscleStrings& bare_pulley() {
  static const MuscleStrings muscle =
      *muscle_strings(pulley().scene, pulley().scene.muscles[0], pulley().bones, bare());
  return muscle;
}

TEST(StringArms, around_a_pulley_are_its_radius_and_the_gap) {
  for (const Real angle : {-30.0, -60.0, -90.0}) {
    const FiberActions actions = actions_at(bare_pulley(), pulley(), radians(angle));
    ASSERT_EQ(actions.arms.rows(), 3);
    for (Index s = 0; s < 3; ++s) {
      EXPECT_FALSE(actions.doubtful[static_cast<std::size_t>(s)]) << angle;
      EXPECT_NEAR(actions.arms(s, 0), radius + bare().bone_gap, 4e-4) << angle;
    }
  }
}

TEST(StringArms, a_string_around_a_pulley_pulls_with_its_tension_at_its_end) {
  const FiberActions actions = actions_at(bare_pulley(), pulley(), radians(-60));
  const Vec3 force = actions.wrenches.col(1).head<3>(), moment = actions.wrenches.col(1).tail<3>();
  EXPECT_LT((force - Vec3(actions.insertion_directions.rowwise().mean())).norm(), 0.02);
  EXPECT_NEAR(moment.y(), radius + bare().bone_gap, 4e-4) << "of the end's pull about the hinge, which is the origin";
  EXPECT_NEAR(moment.y(), actions.mean_arms[0], 1e-6);
  // The body that stands still feels the other end and what the string presses on the pulley.
  const Vec3 origin = actions.origin_directions.rowwise().mean();
  const Vec3 pressed = actions.wrenches.col(0).head<3>() - origin;
  EXPECT_LT((pressed + origin + force).norm(), 1e-4) << "all forces together";
  EXPECT_GT(pressed.norm(), 2 * std::sin(radians(25))) << "a string that turns by 60 degrees presses with its tension";
}

TEST(StringArms, forces_and_moments_on_all_bodies_sum_to_nothing) {
  static const Strung arm(arm_scene());
  const FiberActions actions = actions_at(arm.muscle, arm, radians(60));
  EXPECT_GT(actions.wrenches.col(1).norm(), 0.5);
  EXPECT_LT(actions.wrenches.rowwise().sum().norm(), 1e-4);
  EXPECT_NEAR(actions.wrenches(4, 1), actions.mean_arms[0], 1e-5) << "the hinge turns about y";
}

TEST(StringArms, of_a_tube_around_a_hinge_are_those_of_differences) {
  static const Strung arm(arm_scene());
  Index near = 0, counted = 0;
  for (const Real angle : {20.0, 45.0, 80.0}) {
    const FiberActions actions = actions_at(arm.muscle, arm, radians(angle));
    const std::vector<Real> expected = arms_by_differences(arm, radians(angle));
    Real sum = 0;
    Index kept = 0;
    for (Index s = 0; s < arm.muscle.strings; ++s) {
      if (actions.doubtful[static_cast<std::size_t>(s)]) continue;
      const Real off = actions.arms(s, 0) - expected[static_cast<std::size_t>(s)];
      near += std::abs(off) < 1e-4, ++counted, ++kept;
      sum += off;
    }
    ASSERT_GT(kept, 3 * arm.muscle.strings / 4);
    EXPECT_LT(std::abs(sum) / static_cast<Real>(kept), 1e-4) << angle;
    const Real mean = std::accumulate(expected.begin(), expected.end(), Real{0}) / static_cast<Real>(expected.size());
    EXPECT_NEAR(actions.mean_arms[0], mean, 3e-4) << angle << ", over all, doubtful ones too";
  }
  EXPECT_GT(near, 95 * counted / 100);
}

TEST(StringArms, a_body_that_hardly_matters_makes_no_string_doubtful) {
  Scene scene = arm_scene();
  scene.bodies.push_back("other");
  scene.bones.push_back({"other", 2, shapes::box({0.2, -0.05, 0}, {0.25, 0.05, 0.2})});
  const Strung strung(scene);
  ASSERT_GT(strung.muscle.shares.row(2).maxCoeff(), 0);
  std::vector<Twist> twists(3);
  twists[2].turning = Vec3(1, 2, 3);
  const FiberActions actions = string_actions(strung.muscle, strung.bones, capture_state(strung.muscle, 3), {twists});
  EXPECT_EQ(std::count(actions.doubtful.begin(), actions.doubtful.end(), 1), 0);
  EXPECT_LT(actions.arms.cwiseAbs().maxCoeff(), 1e-3);
}

TEST(StringArms, about_a_coordinate_that_moves_nothing_of_the_muscle_are_zero) {
  const StringState state = capture_state(bare_pulley(), 2);
  const FiberActions actions = string_actions(bare_pulley(), pulley().bones, state, {std::vector<Twist>(2)});
  EXPECT_TRUE(actions.arms.isZero(0));
  EXPECT_TRUE(actions.mean_arms.isZero(0));
}

}  // namespace
}  // namespace gracilis::strings
