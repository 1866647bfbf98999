#include <gracilis/anatomy/joints/joint_control.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {
namespace {

/// One coordinate sampled at these angles (degrees), one muscle.
JointControlUnit unit_of(const std::vector<Real>& angles_deg, const std::vector<Real>& activations, Real falloff = 0) {
  JointControlUnit unit;
  unit.name = "hip";
  unit.joint = "hip_r";
  unit.coordinates = {"hip_flexion_r"};
  unit.muscles = {"iliacus_r"};
  unit.angles =
      Eigen::Map<const Eigen::VectorXd>(angles_deg.data(), static_cast<Index>(angles_deg.size())) * radians(1);
  unit.activations = Eigen::Map<const Eigen::VectorXd>(activations.data(), static_cast<Index>(activations.size()));
  unit.falloff = falloff;
  return unit;
}

Real at(const JointControl& control, Real angle_deg) {
  return control.at(Eigen::VectorXd::Constant(1, radians(angle_deg)))[0];
}

}  // namespace

TEST(JointControl, the_falloff_follows_from_the_median_distance_to_the_nearest_sample) {
  Eigen::MatrixXd samples(5, 1);
  samples << 15, 0, 3, 1, 7;  // from the nearest ones 8, 1, 2, 1 and 4 degrees
  EXPECT_NEAR(falloff_for(samples), 1.0 / (2 * 2 * 2), 1e-12);
  EXPECT_NEAR(falloff_for(samples.topRows(2)), 1.0 / (2 * 15 * 15), 1e-12);
  EXPECT_EQ(falloff_for(samples.topRows(1)), 1);
  EXPECT_EQ(falloff_for(Eigen::MatrixXd::Zero(3, 1)), 1) << "no other place";
}

TEST(JointControl, weighs_samples_by_a_gaussian_of_their_distance_in_degrees) {
  const JointControl control(unit_of({0, 2, 5}, {0.1, 0.5, 0.9}, 0.3));
  const Real a = std::exp(-0.3 * 1), b = std::exp(-0.3 * 1), c = std::exp(-0.3 * 16);
  EXPECT_NEAR(at(control, 1), (0.1 * a + 0.5 * b + 0.9 * c) / (a + b + c), 1e-12);
}

TEST(JointControl, returns_an_exact_hit_as_it_is) {
  const JointControl control(unit_of({0, 2, 5}, {0.1, 0.5, 0.9}, 1e-6));
  EXPECT_EQ(at(control, 2), 0.5) << "although the others weigh as much";
}

TEST(JointControl, a_sample_is_hit_within_a_tolerance) {
  JointControlUnit unit = unit_of({0, 2, 5}, {0.1, 0.5, 0.9}, 1e-6);
  EXPECT_EQ(at(JointControl(unit), std::nextafter(2.0, 3.0)), 0.5) << "one bit beside";
  EXPECT_EQ(at(JointControl(unit), 2 + 1e-8), 0.5);
  EXPECT_NEAR(at(JointControl(unit), 2.01), 0.5, 1e-3);
  EXPECT_NE(at(JointControl(unit), 2.01), 0.5);
  unit.hit_distance = radians(0.1);
  EXPECT_EQ(at(JointControl(unit), 2.01), 0.5);
}

TEST(JointControl, tells_which_samples_it_asks) {
  JointControlUnit unit = unit_of({5, 0, 2, 5}, {0.9, 0.1, 0.5, 0.7}, 1e-6);
  unit.neighbors = 2;
  const JointControl control(unit);
  EXPECT_EQ(control.angles_deg().rows(), 3) << "two of the same angles are one";
  const auto asked_at = [&](Real angle) {
    std::vector<Real> angles;
    for (const Index row : control.neighbors(Eigen::VectorXd::Constant(1, radians(angle))))
      angles.push_back(std::round(control.angles_deg()(row, 0)));
    return angles;
  };
  EXPECT_EQ(asked_at(4), (std::vector<Real>{5, 2}));
  EXPECT_EQ(asked_at(-9), (std::vector<Real>{0, 2}));
  EXPECT_EQ(asked_at(2), (std::vector<Real>{2})) << "one that is hit is the answer";
}

TEST(JointControl, asks_as_many_samples_as_it_is_told) {
  JointControlUnit unit = unit_of({0, 2, 5}, {0.1, 0.5, 0.9}, 1e-9);
  unit.neighbors = 2;
  EXPECT_NEAR(at(JointControl(unit), 1.2), 0.3, 1e-6);
  unit.neighbors = 1;
  EXPECT_EQ(at(JointControl(unit), 1.2), 0.5);
  unit.neighbors = 50;
  EXPECT_NEAR(at(JointControl(unit), 1.2), 0.5, 1e-6);
}

TEST(JointControl, returns_the_nearest_sample_where_all_weights_underflow) {
  const JointControl control(unit_of({0, 2, 5}, {0.1, 0.5, 0.9}, 10));
  EXPECT_EQ(at(control, 90), 0.9);
  EXPECT_EQ(at(control, -50), 0.1);
}

TEST(JointControl, asks_the_ten_nearest_samples_only) {
  std::vector<Real> angles, activations;
  for (int i = 0; i < 11; ++i) angles.push_back(i), activations.push_back(i == 10 ? 1000 : 0);
  const JointControl control(unit_of(angles, activations, 1e-9));
  EXPECT_EQ(at(control, 4.4), 0) << "the eleventh, at 10 degrees, would show";
  EXPECT_GT(at(control, 5.6), 90);
}

TEST(JointControl, measures_distance_over_the_coordinates_of_several_joints) {
  JointControlUnit unit;
  unit.angles.resize(2, 2);
  unit.angles << 0, 0, radians(3), radians(4);
  unit.activations.resize(2, 2);
  unit.activations << 0, 1, 1, 0;
  unit.falloff = 0.01;
  const JointControl control(unit);
  const Eigen::Vector2d q(radians(0.5), 0);
  const Real near = std::exp(-0.01 * 0.25), far = std::exp(-0.01 * (2.5 * 2.5 + 16));
  EXPECT_NEAR(control.at(q)[0], far / (near + far), 1e-12);
  EXPECT_NEAR(control.at(q)[1], near / (near + far), 1e-12);
}

TEST(JointControl, takes_its_falloff_from_the_spacing_of_the_samples) {
  EXPECT_NEAR(JointControl(unit_of({0, 2, 4, 6}, {0, 0, 0, 0})).falloff(), 1.0 / 8, 1e-9);
  EXPECT_EQ(JointControl(unit_of({7}, {0.25})).falloff(), 1);
  EXPECT_EQ(at(JointControl(unit_of({7}, {0.25})), 30), 0.25) << "a single sample is the answer everywhere";
}

TEST(JointControl, takes_the_mean_of_samples_at_the_same_angles) {
  const JointControl control(unit_of({3, 3, 10}, {0.2, 0.4, 1}, 1));
  EXPECT_EQ(control.sample_count(), 2);
  EXPECT_NEAR(at(control, 3), 0.3, 1e-12);
}

TEST(JointControl, interpolates_what_it_was_not_told) {
  std::vector<Real> angles, activations;
  for (int i = 0; i <= 60; ++i) angles.push_back(i), activations.push_back(0.5 + 0.4 * std::sin(0.1 * i));
  EXPECT_LT(leave_out_error(unit_of(angles, activations))[0], 0.01);
  EXPECT_EQ(leave_out_error(unit_of({0, 1}, {0, 1}))[0], 0) << "nothing to leave out";
}

TEST(JointControl, every_other_sample_is_left_out_and_told_by_the_rest) {
  JointControlUnit unit = unit_of({0, 1, 5, 6, 10}, {0.1, 0.4, 0.5, 0.9, 1});
  unit.neighbors = 1;
  // At 1 degree the sample at 0 tells, at 6 that at 5: 0.3 and 0.4 off.
  EXPECT_NEAR(leave_out_error(unit)[0], std::sqrt((0.09 + 0.16) / 2), 1e-12);
  JointControlUnit even = unit_of({0, 1, 5, 6}, {0.1, 0.4, 0.5, 0.7});
  even.neighbors = 1;
  EXPECT_NEAR(leave_out_error(even)[0], std::sqrt((0.09 + 0.04) / 2), 1e-12);
  EXPECT_EQ(leave_out_error(unit_of({0, 1, 2}, {0.2, 0.2, 0.2}))[0], 0);
}

TEST(JointControl, knows_the_body_and_center_of_its_joint) {
  Scene scene;
  scene.bodies = {"pelvis", "femur_r"};
  scene.joints = {{"hip_r", 0, 1, RigidTransform(Eigen::Translation3d(1, 2, 3)), {}}};
  EXPECT_EQ(moving_body(scene, unit_of({0}, {0})).body, 1);
  EXPECT_EQ(moving_body(scene, unit_of({0}, {0})).center, Vec3(1, 2, 3));
}

}  // namespace gracilis
