#include <gracilis/anatomy/activation/activation.hpp>

#include <gracilis/scene/validate.hpp>

#include "scenes_for_tests.hpp"

#include <gtest/gtest.h>

namespace gracilis {
namespace {

Pose pose_of(Real time, Real flexion) {
  Pose pose;
  pose.time = time;
  pose.coordinates = {flexion};
  return pose;
}

}  // namespace

TEST(Activation, of_a_signal_is_linear_in_time_and_constant_beyond) {
  const ActivationSignal signal{"tube", {1, 2, 4}, {0.2, 0.6, 0}};
  EXPECT_EQ(value_at(signal, 0), 0.2);
  EXPECT_NEAR(value_at(signal, 1.5), 0.4, 1e-12);
  EXPECT_NEAR(value_at(signal, 3), 0.3, 1e-12);
  EXPECT_EQ(value_at(signal, 9), 0);
  EXPECT_EQ(value_at({"tube", {0}, {0.3}}, 7), 0.3) << "a constant";
}

TEST(Activation, reaches_a_muscle_in_each_of_the_three_ways) {
  Scene scene = tube_scene();
  EXPECT_EQ(ActivationDriver(scene).at(pose_of(0, 0)), std::vector<Real>{0}) << "relaxed";

  scene.activation.signals = {{"tube", {0, 1}, {0, 1}}};
  EXPECT_NEAR(ActivationDriver(scene).at(pose_of(0.25, 0))[0], 0.25, 1e-12);

  scene.activation = {};
  Eigen::MatrixX2d points(2, 2);
  points << 0, 0.1, 1, 0.5;
  scene.activation.functions = {{"tube", along_coordinate(0, points)}};
  EXPECT_NEAR(ActivationDriver(scene).at(pose_of(0, 0.5))[0], 0.3, 1e-12);

  scene.activation = {};
  JointControlUnit unit{"unit", "hinge", {"flexion"}, {"tube"}, Eigen::MatrixXd::Zero(1, 1), {}, 1};
  unit.activations = Eigen::MatrixXd::Constant(1, 1, 1.7);
  scene.activation.units = {unit};
  EXPECT_TRUE(validate(scene).empty());
  EXPECT_EQ(ActivationDriver(scene).at(pose_of(0, 0.5))[0], 1) << "no more than fully active";
  std::vector<Pose> poses = {pose_of(0, 0), pose_of(1, 1)};
  set_activations(scene, poses);
  EXPECT_EQ(poses[1].activations, std::vector<Real>{1});
}

TEST(Activation, in_two_ways_at_once_or_with_samples_that_do_not_fit_is_refused) {
  Scene scene = tube_scene();
  scene.activation.signals = {{"tube", {0}, {0.5}}, {"tube", {0}, {0.5}}};
  EXPECT_EQ(validate(scene).size(), 1u);
  scene.activation.signals = {{"tube", {1, 1}, {0, 1}}};
  EXPECT_EQ(validate(scene).size(), 1u) << "times that do not increase";
  scene.activation.signals.clear();
  scene.activation.units = {{"unit", "knee", {"knee_flexion"}, {"tube"}, {}, {}, -1}};
  EXPECT_EQ(validate(scene).size(), 4u) << "joint, coordinate, samples, falloff";
}

}  // namespace gracilis
