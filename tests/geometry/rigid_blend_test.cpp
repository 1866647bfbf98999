#include <gracilis/geometry/rigid_blend.hpp>

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

namespace gracilis {
namespace {

RigidTransform random_motion(std::mt19937& generator, Real largest_angle) {
  std::uniform_real_distribution<Real> uniform(-1, 1);
  const Vec3 axis = Vec3(uniform(generator), uniform(generator), uniform(generator)).normalized();
  const Vec3 shift(uniform(generator), uniform(generator), uniform(generator));
  return Eigen::Translation3d(shift) * Eigen::AngleAxisd(largest_angle * uniform(generator), axis);
}

RigidTransform blend_of(const std::vector<RigidTransform>& motions, const std::vector<Real>& weights) {
  return blend(prepare_blend(motions), weights);
}

Real difference(const RigidTransform& a, const RigidTransform& b) { return (a.matrix() - b.matrix()).norm(); }

}  // namespace

TEST(RigidBlend, of_equal_motions_is_that_motion) {
  std::mt19937 generator(1);
  for (int i = 0; i < 50; ++i) {
    const RigidTransform motion = random_motion(generator, pi);
    EXPECT_LT(difference(blend_of({motion, motion, motion}, {0.2, 0.5, 0.3}), motion), 1e-12);
  }
}

TEST(RigidBlend, with_all_weight_on_one_is_that_one) {
  std::mt19937 generator(2);
  for (int i = 0; i < 50; ++i) {
    const RigidTransform a = random_motion(generator, 1.5), b = random_motion(generator, 1.5);
    EXPECT_LT(difference(blend_of({a, b}, {1, 0}), a), 1e-12);
    EXPECT_LT(difference(blend_of({a, b}, {0, 1}), b), 1e-12);
  }
}

TEST(RigidBlend, is_rigid) {
  std::mt19937 generator(3);
  for (int i = 0; i < 100; ++i) {
    const RigidTransform mean = blend_of(
        {random_motion(generator, 1.5), random_motion(generator, 1.5), random_motion(generator, 1.5)}, {0.1, 0.6, 0.3});
    EXPECT_LT((mean.linear() * mean.linear().transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_NEAR(mean.linear().determinant(), 1, 1e-12);
  }
}

TEST(RigidBlend, does_not_depend_on_the_frame) {
  std::mt19937 generator(4);
  for (int i = 0; i < 50; ++i) {
    const RigidTransform a = random_motion(generator, 1.5), b = random_motion(generator, 1.5);
    const RigidTransform frame = random_motion(generator, pi);
    const RigidTransform here = blend_of({a, b}, {0.3, 0.7});
    const RigidTransform there = blend_of({frame * a * frame.inverse(), frame * b * frame.inverse()}, {0.3, 0.7});
    EXPECT_LT(difference(frame * here * frame.inverse(), there), 1e-11);
  }
}

TEST(RigidBlend, half_way_between_rest_and_a_turn_about_a_center_is_half_the_turn_about_it) {
  const Vec3 center(0.1, -0.2, 0.3);
  const auto turn = [&](Real angle) {
    return RigidTransform(Eigen::Translation3d(center) * Eigen::AngleAxisd(angle, Vec3(1, 2, 2) / 3) *
                          Eigen::Translation3d(-center));
  };
  for (Real angle : {0.5, 1.7, 3.0, -3.0})
    EXPECT_LT(difference(blend_of({RigidTransform::Identity(), turn(angle)}, {0.5, 0.5}), turn(angle / 2)), 1e-12)
        << angle;
}

TEST(RigidBlend, of_translations_is_their_mean) {
  const RigidTransform a(Eigen::Translation3d(1, 2, 3)), b(Eigen::Translation3d(-1, 0, 5));
  EXPECT_LT(difference(blend_of({a, b}, {0.25, 0.75}), RigidTransform(Eigen::Translation3d(-0.5, 0.5, 4.5))), 1e-12);
}

TEST(RigidBlend, does_not_depend_on_the_sign_of_quaternions) {
  // Motions just below and above half a turn have quaternions that seem to point apart.
  const RigidTransform a(Eigen::AngleAxisd(pi - 0.05, Vec3::UnitZ())), b(Eigen::AngleAxisd(pi + 0.05, Vec3::UnitZ()));
  EXPECT_LT(difference(blend_of({a, b}, {0.5, 0.5}), RigidTransform(Eigen::AngleAxisd(pi, Vec3::UnitZ()))), 1e-12);
}

}  // namespace gracilis
