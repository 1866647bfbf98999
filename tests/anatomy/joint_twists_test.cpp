#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/anatomy/joints/joint_twists.hpp>

#include <gtest/gtest.h>

namespace gracilis {
namespace {

/// A chain of three bodies: turned frames, three rotations and a translation, then a hinge.
Scene chain() {
  Scene scene;
  scene.bodies = {"ground", "thigh", "shank"};
  RigidTransform hip = RigidTransform::Identity(), knee = hip;
  hip = Eigen::Translation3d(0.1, -0.2, 0.3) * Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized());
  knee = Eigen::Translation3d(0.1, -0.6, 0.25) * Eigen::AngleAxisd(-0.7, Vec3(3, -1, 2).normalized());
  scene.joints = {{"hip",
                   0,
                   1,
                   hip,
                   {{"flexion", Vec3::UnitZ(), 0.1, -2, 2},
                    {"slide", Vec3::UnitX(), 0.01, -0.1, 0.1},
                    {"adduction", Vec3::UnitX(), 0, -2, 2},
                    {"rotation", Vec3::UnitY(), -0.2, -2, 2}}},
                  {"knee", 1, 2, knee, {{"knee", Vec3::UnitX(), 0.3, -2, 2}}}};
  scene.joints[0].axes[1].translation = true;
  return scene;
}

TEST(JointTwists, are_the_derivative_of_the_pose) {
  const Scene scene = chain();
  const std::vector<Real> at = {0.7, 0.03, -0.3, 0.5, 1.1};
  const auto twists = joint_twists(scene, at);
  ASSERT_EQ(twists.size(), at.size());
  constexpr Real step = 1e-6;
  const Pose here = pose_at(scene, at);
  for (std::size_t c = 0; c < at.size(); ++c) {
    std::vector<Real> low = at, high = at;
    low[c] -= step, high[c] += step;
    const Pose before = pose_at(scene, low), after = pose_at(scene, high);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
      for (const Vec3& point : {Vec3(0, 0, 0), Vec3(0.3, 0.1, -0.2), Vec3(-0.1, 0.4, 0.2)}) {
        const Vec3 moved = (after.bodies[b] * point - before.bodies[b] * point) / (2 * step);
        EXPECT_LT((twists[c][b].velocity_at(here.bodies[b] * point) - moved).norm(), 1e-8) << c << " " << b;
      }
  }
}

}  // namespace
}  // namespace gracilis
