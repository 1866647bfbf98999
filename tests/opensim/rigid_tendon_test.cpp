#include <gracilis/opensim/static_optimization/rigid_tendon.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis::opensim {

static Muscle thelen() {
  Muscle muscle;
  muscle.type = "Thelen2003Muscle";
  muscle.max_isometric_force = 500;
  muscle.optimal_fiber_length = 0.1;
  muscle.tendon_slack_length = 0.2;
  muscle.pennation_angle_at_optimal = 0.3;
  muscle.max_contraction_velocity = 10;
  muscle.active_shape = 0.5;
  muscle.velocity_shape = 0.3;
  muscle.eccentric_force = 1.8;
  return muscle;
}

TEST(RigidTendon, at_optimal_length_and_rest_the_force_is_the_isometric_one_along_the_tendon) {
  EXPECT_NEAR(rigid_tendon_force(thelen(), 0.2 + 0.1 * std::cos(0.3), 0), 500 * std::cos(0.3), 1e-10);
}

TEST(RigidTendon, fibers_keep_their_distance_from_the_tendons_line) {
  const Real height = 0.1 * std::sin(0.3), fiber = std::hypot(0.05, height);
  const Real factor = std::exp(-(fiber / 0.1 - 1) * (fiber / 0.1 - 1) / 0.5);
  EXPECT_NEAR(rigid_tendon_force(thelen(), 0.25, 0), 500 * factor * 0.05 / fiber, 1e-10);
}

TEST(RigidTendon, a_slack_path_gives_no_force) {
  EXPECT_EQ(rigid_tendon_force(thelen(), 0.19, 0), 0);
  EXPECT_EQ(rigid_tendon_force(thelen(), 0.2001, 0), 0);  // fibers across the tendon
}

TEST(RigidTendon, velocity_follows_thelens_hyperbolas) {
  const Muscle muscle = thelen();
  EXPECT_EQ(force_velocity_factor(muscle, 0), 1);
  EXPECT_EQ(force_velocity_factor(muscle, -1), 0);
  EXPECT_EQ(force_velocity_factor(muscle, -2), 0);
  EXPECT_NEAR(force_velocity_factor(muscle, -0.5), 0.5 / (1 + 0.5 / 0.3), 1e-15);
  // Stretching: v = (f - 1) (Flen - 1) / ((2 + 2 / Af) (Flen - f)).
  const Real f = 1.4, speed = (f - 1) * 0.8 / ((2 + 2 / 0.3) * (1.8 - f));
  EXPECT_NEAR(force_velocity_factor(muscle, speed), f, 1e-14);
}

TEST(RigidTendon, the_velocity_curve_goes_on_straight_and_smoothly) {
  const Muscle muscle = thelen();
  const Real last = 0.95 * 1.8, joint = (last - 1) * 0.8 / ((2 + 2 / 0.3) * (1.8 - last)), step = 1e-6;
  const auto factor = [&](Real speed) { return force_velocity_factor(muscle, speed); };
  EXPECT_NEAR(factor(joint), last, 1e-12);
  EXPECT_NEAR((factor(joint + step) - factor(joint)) / (factor(joint) - factor(joint - step)), 1, 1e-4);
  EXPECT_NEAR(factor(joint + 2) - factor(joint + 1), factor(joint + 1) - factor(joint), 1e-12);
}

TEST(RigidTendon, other_muscles_have_the_smooth_curves) {
  Muscle muscle = thelen();
  muscle.type = "DeGrooteFregly2016Muscle";
  EXPECT_NEAR(force_velocity_factor(muscle, 0), 1, 1e-4);
  EXPECT_NEAR(force_velocity_factor(muscle, -1), 0, 1e-4);
  EXPECT_NEAR(force_length_factor(muscle, 1), 1, 0.01);
  EXPECT_LT(force_length_factor(muscle, 0.5), 0.4);
}

}  // namespace gracilis::opensim
