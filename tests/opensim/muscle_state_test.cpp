#include <gracilis/opensim/static_optimization/muscle_state.hpp>
#include <gracilis/opensim/static_optimization/rigid_tendon.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis::opensim {

static Muscle strong_muscle(const std::string& type) {
  Muscle muscle;
  muscle.type = type;
  muscle.max_isometric_force = 800;
  muscle.optimal_fiber_length = 0.08;
  muscle.tendon_slack_length = 0.25;
  muscle.pennation_angle_at_optimal = 0.35;
  muscle.tendon_strain = 0.049;
  if (type == "Millard2012EquilibriumMuscle") muscle.fiber_damping = 0.1;
  if (type == "DeGrooteFregly2016Muscle") muscle.passive_shape = 4;
  return muscle;
}

class MuscleStateOf : public testing::TestWithParam<const char*> {
 protected:
  Muscle muscle = strong_muscle(GetParam());
};

TEST_P(MuscleStateOf, fibers_and_tendon_pull_alike) {
  for (const Real activation : {0.01, 0.4, 1.0}) {
    for (const Real length : {0.31, 0.34, 0.37}) {
      const MuscleState state = muscle_state(muscle, activation, length, 0, true);
      const Real height = 0.08 * std::sin(0.35), along = std::sqrt(std::pow(state.fiber_length, 2) - height * height);
      const Real normal = state.fiber_length / 0.08;
      const Real fibers =
          activation * force_length_factor(muscle, normal) * force_velocity_factor(muscle, 0, activation) +
          passive_factor(muscle, normal);
      EXPECT_NEAR(state.force, 800 * fibers * along / state.fiber_length, 1e-6);
      EXPECT_NEAR(state.force, 800 * tendon_factor(muscle, (length - along) / 0.25), 1e-6);
    }
  }
}

TEST_P(MuscleStateOf, a_slack_muscle_pulls_with_nothing) {
  EXPECT_EQ(muscle_state(muscle, 1, 0.24, 0, true).force, 0);
  EXPECT_EQ(muscle_state(muscle, 1, 0.24, 0, false).force, 0);
}

TEST_P(MuscleStateOf, slow_fibers_take_the_share_by_which_equilibrium_moves) {
  const Real length = 0.335, step = 1e-6, speed = 1e-6;  // too slow for the force-velocity curve to matter
  const Real longer = muscle_state(muscle, 0.5, length + step, 0, true).fiber_length;
  const Real shorter = muscle_state(muscle, 0.5, length - step, 0, true).fiber_length;
  const MuscleState state = muscle_state(muscle, 0.5, length, speed, true);
  EXPECT_NEAR(state.fiber_speed / speed, (longer - shorter) / (2 * step), 2e-3);
  EXPECT_GT(state.fiber_speed, 0.3 * speed);
}

TEST_P(MuscleStateOf, a_tendon_that_hardly_gives_is_a_rigid_one) {
  muscle.tendon_slack_length = 0.01;  // a short one stretches little
  const MuscleState elastic = muscle_state(muscle, 0.6, 0.01 + 0.075, -0.02, true);
  const MuscleState rigid = muscle_state(muscle, 0.6, 0.01 + 0.075, -0.02, false);
  EXPECT_NEAR(elastic.force, rigid.force, 0.01 * rigid.force);
  muscle.ignore_tendon_compliance = true;
  EXPECT_EQ(muscle_state(muscle, 0.6, 0.085, -0.02, true).force, rigid.force);
}

TEST_P(MuscleStateOf, rigid_force_is_active_and_passive_force_along_the_tendon) {
  const Real along = 0.1, height = 0.08 * std::sin(0.35), fiber = std::hypot(along, height), speed = -0.1;
  const Real slow = speed * along / fiber / (10 * 0.08);
  const Real normal = fiber / 0.08;
  const Real expected = (0.3 * force_length_factor(muscle, normal) * force_velocity_factor(muscle, slow, 0.3) +
                         passive_factor(muscle, normal) + muscle.fiber_damping * slow) *
                        along / fiber;
  EXPECT_NEAR(muscle_state(muscle, 0.3, 0.25 + along, speed, false).force, 800 * expected, 1e-9);
  EXPECT_GT(passive_factor(muscle, normal), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Curves, MuscleStateOf,
                         testing::Values("Thelen2003Muscle", "Millard2012EquilibriumMuscle",
                                         "DeGrooteFregly2016Muscle"));

TEST(RigidTendon, has_the_cosines_that_opensim_has) {
  const Real along = 0.06, height = 0.08 * std::sin(0.35), fiber = std::hypot(along, height);
  const Muscle de_groote = strong_muscle("DeGrooteFregly2016Muscle");
  EXPECT_NEAR(rigid_tendon_force(de_groote, 0.25 + along, 0),
              800 * force_length_factor(de_groote, fiber / 0.08) * force_velocity_factor(de_groote, 0), 1e-9);
  const Muscle millard = strong_muscle("Millard2012EquilibriumMuscle");
  const Real cosine = std::cos(std::asin(height / (fiber / 0.08)));  // of a fiber of the normalized length, in metres
  EXPECT_NEAR(rigid_tendon_force(millard, 0.25 + along, 0), 800 * force_length_factor(millard, fiber / 0.08) * cosine,
              1e-9);
  EXPECT_EQ(rigid_tendon_force(millard, 0.25 + 0.02, 0), 0);  // shorter than active fibers are
}

}  // namespace gracilis::opensim
