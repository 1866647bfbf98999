#include <gracilis/geometry/measures.hpp>
#include <gracilis/methods/xpbd/motion.hpp>
#include <gracilis/methods/xpbd/preparation.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gracilis {
namespace {

/// What an edge aims at over its length at rest, with the middle between its ends at rest.
struct Aim {
  Vec3 middle, along;  ///< m; unit
  Real ratio;
};

/// Its carriers' shares are linear along it.
Scene tube_without_tendons() {
  XpbdSettings settings;
  settings.tendon_length = 0;
  return tube_scene(settings);
}

std::vector<Aim> aims(const xpbd::PreparedMuscle& prepared, const Pose& pose) {
  const DistanceSet& edges = prepared.system.distances;
  xpbd::MuscleState state = xpbd::make_muscle_state(prepared, pose.bodies.size());
  xpbd::set_target_lengths(prepared, pose, state);
  const AlignedVector<float>& target = state.target_length;
  std::vector<Aim> all;
  for (std::size_t slot = 0; slot < target.size(); ++slot) {
    if (edges.a[slot] >= prepared.rest.cols()) continue;
    const Vec3 a = prepared.rest.col(edges.a[slot]), b = prepared.rest.col(edges.b[slot]);
    all.push_back({(a + b) / 2, (b - a).normalized(), static_cast<Real>(target[slot] / edges.rest_length[slot])});
  }
  return all;
}

}  // namespace

TEST(XpbdMotion, a_muscle_bent_about_its_middle_aims_at_a_shorter_front_and_a_longer_back) {
  Scene scene = tube_without_tendons();
  const Real axis = 0.0255, free_length = 0.144;  // of the tube; between the rings that are attached
  scene.joints[0].frame = Eigen::Translation3d(axis, 0, 0) * RigidTransform::Identity();
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], tube_fields());
  const Real angle = radians(60);
  // Half way the blend of two rotations turns by 4 tan(φ/4) per share, and the shares are linear along a tube.
  const Real turn = 4 * std::tan(angle / 4) / free_length;
  Index along = 0;
  Real shortest = 1, longest = 1;
  for (const Aim& aim : aims(prepared, flexed(scene, angle))) {
    if (std::abs(aim.middle.z()) > 0.003 || std::abs(aim.along.z()) < 0.9999) continue;
    const Real x = aim.middle.x() - axis;
    EXPECT_NEAR(aim.ratio, std::hypot(1 + turn * x, turn * aim.middle.z()), 5e-4) << "at " << x;
    shortest = std::min(shortest, aim.ratio), longest = std::max(longest, aim.ratio);
    ++along;
  }
  EXPECT_GE(along, 20);
  EXPECT_LT(shortest, 0.93);
  EXPECT_GT(longest, 1.07);
}

TEST(XpbdMotion, a_muscle_whose_ends_approach_aims_at_shorter_fibers_down_to_a_limit) {
  const Scene scene = tube_without_tendons();
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], tube_fields());
  for (const Real share : {0.8, 0.5, 0.2}) {
    Pose closer = flexed(scene, 0);
    closer.bodies[1].translation().z() += (1 - share) * 0.144;
    Index along = 0, across = 0;
    for (const Aim& aim : aims(prepared, closer)) {
      if (std::abs(aim.middle.z()) > 0.07) continue;
      if (std::abs(aim.along.z()) > 0.9999) {
        EXPECT_NEAR(aim.ratio, std::max(share, 0.4), 1e-3);
        ++along;
      }
      if (std::abs(aim.along.z()) < 1e-6) {
        EXPECT_NEAR(aim.ratio, 1, 1e-3);
        ++across;
      }
    }
    EXPECT_GT(along, 300);
    EXPECT_GT(across, 300);
  }
}

TEST(XpbdMotion, a_stretched_muscle_aims_at_a_longer_and_thinner_shape_of_its_own_volume) {
  const Scene scene = tube_without_tendons();
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], tube_fields());
  Pose farther = flexed(scene, 0);
  farther.bodies[1].translation().z() -= 0.5 * 0.144;
  const Points& rest = prepared.rest;
  const Real volume = enclosed_volume(xpbd::skinned_rest(prepared, farther, {}), prepared.faces) /
                      enclosed_volume(rest, prepared.faces);
  EXPECT_NEAR(volume, 1 + 0.5 * 0.144 / 0.16, 1e-6);
  Index along = 0, across = 0;
  for (const Aim& aim : aims(prepared, farther)) {
    if (std::abs(aim.middle.z()) > 0.07) continue;
    if (std::abs(aim.along.z()) > 0.9999) {
      EXPECT_NEAR(aim.ratio, 1.5 / std::cbrt(volume), 1e-3);
      ++along;
    }
    if (std::abs(aim.along.z()) < 1e-6) {
      EXPECT_NEAR(aim.ratio, 1 / std::cbrt(volume), 1e-3);
      ++across;
    }
  }
  EXPECT_GT(along, 300);
  EXPECT_GT(across, 300);
}

TEST(XpbdMotion,
     carried_back_to_the_capture_pose_a_relaxed_muscle_gives_up_its_displacement_by_the_square_of_the_turn) {
  const Scene scene = tube_without_tendons();
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], tube_fields());
  const Real kept = 1 - prepared.settings.shape_recovery, displacement = 0.004;
  const auto left = [&](Real from, Real to, bool active) {
    const auto carried = [&](Real angle) -> Points {
      return xpbd::skinned_rest(prepared, flexed(scene, radians(angle)), {});
    };
    xpbd::MuscleState state = xpbd::make_muscle_state(prepared, scene.bodies.size());
    Particles& particles = state.particles;
    const Points before = carried(from), after = carried(to);
    for (Index p = 0; p < particles.count(); ++p)
      if (prepared.fixed_body[static_cast<std::size_t>(p)] < 0)
        particles.position(p) = (before.col(p) + Vec3(displacement, 0, 0)).cast<float>();
    xpbd::skin_free(prepared, flexed(scene, radians(from)), flexed(scene, radians(to)), active, state);
    Real largest = 0;
    for (Index p = 0; p < particles.count(); ++p)
      if (prepared.fixed_body[static_cast<std::size_t>(p)] < 0)
        largest = std::max(largest, (particles.position(p).cast<Real>() - after.col(p)).norm());
    return largest / displacement;
  };
  EXPECT_NEAR(left(30, 31, false), kept, 1e-4) << "away from the capture pose";
  EXPECT_NEAR(left(30, 24, false), 0.64 * kept, 1e-4) << "towards it";
  EXPECT_NEAR(left(30, 0, false), 0.25 * kept, 1e-4) << "down to 15 degrees";
  EXPECT_NEAR(left(10, 4, false), kept, 1e-4) << "and no more near it, so that the way through it is smooth";
  EXPECT_NEAR(left(30, 24, true), kept, 1e-4) << "an active one pulls by itself";
}

TEST(XpbdMotion, no_edge_aims_beyond_the_stretch_limit) {
  XpbdSettings settings;
  settings.stretch_limit = 1.25;
  const Scene scene = tube_scene(settings);
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], tube_fields());
  Pose farther = flexed(scene, 0);
  farther.bodies[1].translation().z() -= 0.144;
  Real longest = 0;
  for (const Aim& aim : aims(prepared, farther)) longest = std::max(longest, aim.ratio);
  EXPECT_NEAR(longest, 1.25, 1e-5);
}

TEST(XpbdMotion, edges_aim_at_their_lengths_at_rest_in_the_capture_pose_and_when_all_bodies_move_alike) {
  const Scene scene = tube_without_tendons();
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], tube_fields());
  Pose pose = flexed(scene, 0);
  const RigidTransform moved = Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(2, Vec3(1, 2, 2) / 3);
  for (const RigidTransform& by : {RigidTransform::Identity(), moved}) {
    for (RigidTransform& body : pose.bodies) body = by;
    for (const Aim& aim : aims(prepared, pose)) EXPECT_NEAR(aim.ratio, 1, 3e-7);
  }
}

TEST(XpbdMotion, without_slack_uptake_edges_aim_at_their_lengths_at_rest) {
  XpbdSettings settings;
  settings.slack_uptake = false;
  const Scene scene = tube_scene(settings);
  const xpbd::PreparedMuscle prepared = xpbd::prepare_muscle(scene, scene.muscles[0], tube_fields());
  for (const Aim& aim : aims(prepared, flexed(scene, radians(60)))) EXPECT_EQ(aim.ratio, 1);
}

}  // namespace gracilis
