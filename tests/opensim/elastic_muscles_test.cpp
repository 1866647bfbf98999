#include "opensim/model_texts.hpp"

#include <gracilis/opensim/static_optimization/rigid_tendon.hpp>
#include <gracilis/opensim/static_optimization/static_optimization.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace gracilis::opensim {

/// A foot that hangs on a shank by a hinge and would fall; a calf muscle holds it from behind.
static Model ankle(const std::string& muscle_type, const std::string& springs = "") {
  const std::string calf =
      "<" + muscle_type + " name=\"calf\"><max_isometric_force>600</max_isometric_force><optimal_fiber_length>0.06" +
      "</optimal_fiber_length><tendon_slack_length>0.26</tendon_slack_length><pennation_angle_at_optimal>0.3" +
      "</pennation_angle_at_optimal><GeometryPath>" +
      set("PathPointSet", point("/ground", "-0.3 0 0") + point("/bodyset/rod", "0 -0.1 0")) + "</GeometryPath></" +
      muscle_type + ">";
  return model_from(pendulum(calf + springs));
}

static CoordinateMotion held_at(Real angle) {
  CoordinateMotion motion;
  for (int i = 0; i < 8; ++i) motion.times.push_back(0.1 * i);
  motion.values = Eigen::MatrixXd::Constant(8, 1, angle);
  return motion;
}

static StaticOptimizationResult solved(const Model& model, MuscleForces kind, Real angle = 0.3) {
  StaticOptimizationSettings settings;
  settings.muscle_forces = kind;
  return static_optimization(model, held_at(angle), {}, {3}, settings);
}

/// The calf's length, and its arm (below zero: it swings the foot back).
static std::pair<Real, Real> calf_at(Real angle) {
  const Vec3 from(-0.3, 0, 0), to(0.1 * std::sin(angle), -0.1 * std::cos(angle), 0);
  const Real length = (to - from).norm();
  return {length, -(to - from).dot(Vec3(0.1 * std::cos(angle), 0.1 * std::sin(angle), 0)) / length};
}

static Real falling_moment(Real angle) { return 2 * 9.80665 * 0.5 * std::sin(angle); }

TEST(ElasticMuscles, hold_a_foot_with_the_activation_of_their_equilibrium) {
  const Real angle = -0.3;  // forward of the hinge, so that it falls away from the muscle
  const auto [length, arm] = calf_at(angle);
  ASSERT_LT(arm, 0);
  for (const char* type : {"Thelen2003Muscle", "Millard2012EquilibriumMuscle", "DeGrooteFregly2016Muscle"}) {
    const Model model = ankle(type);
    const Real needed = falling_moment(angle) / arm;
    for (const MuscleForces kind : {MuscleForces::rigid, MuscleForces::elastic}) {
      const StaticOptimizationResult result = solved(model, kind, angle);
      ASSERT_TRUE(result.infeasible.empty()) << type;
      const Real activation = result.activations.values(0, 0);
      const MuscleState state = muscle_state(model.muscles[0], activation, length, 0, kind == MuscleForces::elastic);
      EXPECT_GT(activation, 0.02);
      EXPECT_LT(activation, 0.98);
      EXPECT_NEAR(state.force, needed, 1e-4 * needed) << type;
      EXPECT_NEAR(result.forces.values(0, 0), needed, 1e-4 * needed);
      EXPECT_NEAR(result.fiber_lengths.values(0, 0), state.fiber_length, 1e-9);
    }
    EXPECT_NE(solved(model, MuscleForces::rigid, angle).activations.values(0, 0),
              solved(model, MuscleForces::elastic, angle).activations.values(0, 0));
    EXPECT_TRUE(solved(model, MuscleForces::opensim, angle).fiber_lengths.columns.empty());
  }
}

TEST(ElasticMuscles, share_a_load_with_the_least_cost) {
  // Two calves alike but for their strength: the cost is least where activations are as the moments they add.
  Model model = ankle("Millard2012EquilibriumMuscle");
  model.muscles.push_back(model.muscles[0]);
  model.muscles[1].name = "other";
  model.muscles[1].max_isometric_force = 300;
  const Real angle = -0.3;
  const auto [length, arm] = calf_at(angle);
  const StaticOptimizationResult result = solved(model, MuscleForces::elastic, angle);
  ASSERT_TRUE(result.infeasible.empty());
  const auto growth = [&](std::size_t m) {
    const Real a = result.activations.values(0, static_cast<Eigen::Index>(m)), h = 1e-4;
    const auto force = [&](Real at) { return muscle_state(model.muscles[m], at, length, 0, true).force; };
    return (force(a + h) - force(a - h)) / (2 * h);
  };
  EXPECT_NEAR(result.activations.values(0, 0) / growth(0), result.activations.values(0, 1) / growth(1), 1e-7);
  EXPECT_NEAR(result.forces.values.row(0).sum() * arm, falling_moment(angle), 1e-4);
}

/// Springs of every kind at the ankle: what is left for the muscle is the moment without theirs.
TEST(AnkleSprings, leave_the_muscle_what_they_do_not_hold) {
  const std::string frames = "<socket_frame1>/ground</socket_frame1><socket_frame2>/bodyset/rod</socket_frame2>";
  const std::string way = "<GeometryPath>" +
                          set("PathPointSet", point("/ground", "-0.2 0 0") + point("/bodyset/rod", "0 -0.1 0")) +
                          "</GeometryPath>";
  const std::vector<std::string> springs = {
      "<BushingForce name=\"s\">" + frames + "<rotational_stiffness>0 0 6</rotational_stiffness></BushingForce>",
      "<ExpressionBasedBushingForce name=\"s\">" + frames +
          "<Mz_expression>6*theta_z</Mz_expression></ExpressionBasedBushingForce>",
      "<ExpressionBasedCoordinateForce name=\"s\"><coordinate>swing</coordinate><expression>-6*q</expression>"
      "</ExpressionBasedCoordinateForce>",
      "<SpringGeneralizedForce name=\"s\"><coordinate>swing</coordinate><stiffness>6</stiffness>"
      "</SpringGeneralizedForce>",
      "<Blankevoort1991Ligament name=\"s\">" + way +
          "<linear_stiffness>60</linear_stiffness><slack_length>0.15</slack_length></Blankevoort1991Ligament>",
      "<PathSpring name=\"s\">" + way + "<resting_length>0.15</resting_length><stiffness>200</stiffness></PathSpring>"};
  const Real angle = -0.3;
  const auto [length, arm] = calf_at(angle);
  const Real strongest = rigid_tendon_force(ankle("Thelen2003Muscle").muscles[0], length, 0);
  const Real without = falling_moment(angle) / arm / strongest;
  for (const std::string& spring : springs) {
    const Model model = ankle("Thelen2003Muscle", spring);
    ASSERT_TRUE(model.unsupported.empty()) << spring;
    // Stiffness 6 N m per rad about the hinge; along the way the spring's tension times the way's arm.
    const Vec3 from(-0.2, 0, 0), to(0.1 * std::sin(angle), -0.1 * std::cos(angle), 0);
    const Real way_length = (to - from).norm();
    const Real way_arm = -(to - from).dot(Vec3(0.1 * std::cos(angle), 0.1 * std::sin(angle), 0)) / way_length;
    Real moment = -6 * angle;
    if (spring.find("PathSpring") != std::string::npos) moment = 200 * (way_length - 0.15) * way_arm;
    if (spring.find("Blankevoort") != std::string::npos) moment = 60 * (way_length / 0.15 - 1 - 0.03) * way_arm;
    const StaticOptimizationResult result = solved(model, MuscleForces::opensim, angle);
    ASSERT_TRUE(result.infeasible.empty()) << spring;
    EXPECT_NEAR(result.activations.values(0, 0), (falling_moment(angle) - moment) / arm / strongest, 1e-6) << spring;
    EXPECT_GT(std::abs(result.activations.values(0, 0) - without), 0.01) << spring;
  }
}

}  // namespace gracilis::opensim
