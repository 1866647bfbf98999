#include "opensim/model_texts.hpp"

#include <gracilis/opensim/static_optimization/passive_forces.hpp>
#include <gracilis/opensim/static_optimization/static_optimization.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace gracilis::opensim {

/// The generalized force on the pendulum's only coordinate.
static Real force_of(const std::string& force, Real swing, Real speed = 0) {
  const Model model = model_from(pendulum(force));
  EXPECT_THAT(model.unsupported, testing::IsEmpty());
  Skeleton skeleton(model);
  const Eigen::VectorXd q = Eigen::VectorXd::Constant(1, swing);
  skeleton.place(q);
  return skeleton.generalized_forces(passive_forces(skeleton, q, Eigen::VectorXd::Constant(1, speed)))[0];
}

TEST(PassiveForces, a_limit_pushes_back_beyond_its_values_and_nowhere_else) {
  const std::string limit =
      "<CoordinateLimitForce "
      "name=\"l\"><coordinate>swing</coordinate><upper_stiffness>2</upper_stiffness><upper_limit>30"
      "</upper_limit><lower_stiffness>3</lower_stiffness><lower_limit>-10</lower_limit><damping>0.1</"
      "damping><transition>5"
      "</transition></CoordinateLimitForce>";
  EXPECT_EQ(force_of(limit, radians(20), 5), 0);
  EXPECT_NEAR(force_of(limit, radians(40)), -2 * 10, 1e-9);  // N·m per degree, 10 degrees beyond
  EXPECT_NEAR(force_of(limit, radians(-30)), 3 * 20, 1e-9);
  EXPECT_NEAR(force_of(limit, radians(32.5)), -0.5 * 2 * 2.5, 1e-9);  // in the middle of the transition
  EXPECT_NEAR(force_of(limit, radians(40), radians(7)) - force_of(limit, radians(40)), -0.1 * 7, 1e-9);
}

TEST(PassiveForces, a_coordinate_s_spring_pulls_to_its_rest) {
  EXPECT_NEAR(force_of("<SpringGeneralizedForce name=\"s\"><coordinate>swing</coordinate><stiffness>7</stiffness>"
                       "<rest_length>0.1</rest_length><viscosity>0.5</viscosity></SpringGeneralizedForce>",
                       0.4, 2),
              -7 * 0.3 - 0.5 * 2, 1e-12);
}

/// From (0.3, 0) on the ground to 0.4 below the hinge on the rod: the length at swing q, and -dL/dq.
static std::pair<Real, Real> way_at(Real swing) {
  const Vec3 from(0.3, 0, 0), to(0.4 * std::sin(swing), -0.4 * std::cos(swing), 0);
  const Real length = (to - from).norm();
  return {length, -(to - from).dot(Vec3(0.4 * std::cos(swing), 0.4 * std::sin(swing), 0)) / length};
}

static const std::string spring_way =
    "<GeometryPath>" + set("PathPointSet", point("/ground", "0.3 0 0") + point("/bodyset/rod", "0 -0.4 0")) +
    "</GeometryPath>";

TEST(PassiveForces, a_path_s_spring_pulls_only_when_longer_than_at_rest) {
  const std::string spring = "<PathSpring name=\"p\">" + spring_way +
                             "<resting_length>0.45</resting_length><stiffness>1000</stiffness><dissipation>0.2"
                             "</dissipation></PathSpring>";
  const auto [length, arm] = way_at(-0.3);
  ASSERT_GT(length, 0.45);
  EXPECT_NEAR(force_of(spring, -0.3), 1000 * (length - 0.45) * arm, 1e-9);
  EXPECT_NEAR(force_of(spring, -0.3, 2), 1000 * (length - 0.45) * (1 - 0.2 * arm * 2) * arm, 1e-9);
  EXPECT_LT(way_at(0.9).first, 0.45);
  EXPECT_EQ(force_of(spring, 0.9), 0);
}

TEST(PassiveForces, a_ligament_pulls_by_its_curve) {
  const std::string ligament =
      "<Ligament name=\"l\">" + spring_way +
      "<resting_length>0.5</resting_length><pcsa_force>300</pcsa_force>"
      "<force_length_curve><PiecewiseLinearFunction><x>0 1 2</x><y>0 0 4</y></PiecewiseLinearFunction>"
      "</force_length_curve></Ligament>";
  const auto [length, arm] = way_at(-0.4);
  ASSERT_GT(length, 0.5);
  EXPECT_NEAR(force_of(ligament, -0.4), 300 * 4 * (length / 0.5 - 1) * arm, 1e-9);
}

TEST(PassiveForces, a_spring_between_points_pulls_along_the_line_between_them) {
  const auto [length, arm] = way_at(0.5);
  EXPECT_NEAR(force_of("<PointToPointSpring name=\"s\"><socket_body1>/ground</socket_body1><socket_body2>/bodyset/rod"
                       "</socket_body2><point1>0.3 0 0</point1><point2>0 -0.4 0</point2><stiffness>50</stiffness>"
                       "<rest_length>0.6</rest_length></PointToPointSpring>",
                       0.5),
              50 * (length - 0.6) * arm, 1e-9);
}

TEST(PassiveForces, a_bushing_resists_turning_and_shifting_of_its_frames) {
  const std::string bushing =
      "<BushingForce name=\"b\"><socket_frame1>/ground</socket_frame1><socket_frame2>/bodyset/rod</socket_frame2>"
      "<rotational_stiffness>1 2 30</rotational_stiffness><translational_stiffness>0 0 0</translational_stiffness>"
      "<rotational_damping>0 0 4</rotational_damping></BushingForce>";
  EXPECT_NEAR(force_of(bushing, 0.6, 0.5), -30 * 0.6 - 4 * 0.5, 1e-6);
  // Frames 0.2 m down the rod and beside the hinge: the translation between them changes with the swing.
  const std::string shifted =
      "<BushingForce name=\"b\"><body_1>ground</body_1><body_2>rod</body_2><location_body_2>0 -0.2 0</location_body_2>"
      "<translational_stiffness>100 0 0</translational_stiffness></BushingForce>";
  EXPECT_NEAR(force_of(shifted, 0.6), -100 * 0.2 * std::sin(0.6) * 0.2 * std::cos(0.6), 1e-6);
}

TEST(PassiveForces, blankevoorts_ligament_is_curved_then_straight) {
  const auto ligament = [](const std::string& slack) {
    return "<Blankevoort1991Ligament name=\"l\">" + spring_way + "<linear_stiffness>500</linear_stiffness>" +
           "<transition_strain>0.06</transition_strain><damping_coefficient>20</damping_coefficient><slack_length>" +
           slack + "</slack_length></Blankevoort1991Ligament>";
  };
  const auto [length, arm] = way_at(-0.3);
  const Real toe = length / 0.55 - 1, straight = length / 0.5 - 1;
  ASSERT_TRUE(toe > 0 && toe < 0.06 && straight > 0.06);
  EXPECT_NEAR(force_of(ligament("0.55"), -0.3), 0.5 * 500 / 0.06 * toe * toe * arm, 1e-9);
  EXPECT_NEAR(force_of(ligament("0.5"), -0.3), 500 * (straight - 0.03) * arm, 1e-9);
  EXPECT_EQ(force_of(ligament("0.7"), -0.3), 0);
  ASSERT_GT(arm, 0);  // so it becomes longer when the swing goes back
  EXPECT_NEAR(force_of(ligament("0.5"), -0.3, -2), (500 * (straight - 0.03) + 20 * arm * 2 / 0.5) * arm, 1e-9);
  EXPECT_NEAR(force_of(ligament("0.5"), -0.3, 2), 500 * (straight - 0.03) * arm, 1e-9);  // damped only so
}

TEST(PassiveForces, formulas_make_forces) {
  const std::string bushing =
      "<ExpressionBasedBushingForce name=\"b\"><socket_frame1>/ground</socket_frame1><socket_frame2>/bodyset/rod"
      "</socket_frame2><Mz_expression>-0.3 + 30*theta_z + 100*theta_z^3</Mz_expression>"
      "<rotational_damping>0 0 4</rotational_damping></ExpressionBasedBushingForce>";
  EXPECT_NEAR(force_of(bushing, 0.6, 0.5), 0.3 - 30 * 0.6 - 100 * 0.216 - 4 * 0.5, 1e-6);
  EXPECT_NEAR(force_of("<ExpressionBasedCoordinateForce name=\"c\"><coordinate>swing</coordinate>"
                       "<expression>-2*exp(q)-3*qdot*square(q)</expression></ExpressionBasedCoordinateForce>",
                       0.5, 1.5),
              -2 * std::exp(0.5) - 3 * 1.5 * 0.25, 1e-12);
  const auto [length, arm] = way_at(0.5);
  EXPECT_NEAR(force_of("<ExpressionBasedPointToPointForce name=\"s\"><body1>ground</body1><body2>rod</body2>"
                       "<point1>0.3 0 0</point1><point2>0 -0.4 0</point2><expression>50*(d-0.6)-ddot</expression>"
                       "</ExpressionBasedPointToPointForce>",
                       0.5, 2),
              (50 * (length - 0.6) + arm * 2) * arm, 1e-7);
}

TEST(PassiveForces, with_formulas_that_are_not_understood_are_named_as_missing) {
  const Model model = model_from(
      pendulum("<ExpressionBasedCoordinateForce name=\"c\"><coordinate>swing</coordinate><expression>2*nothing"
               "</expression></ExpressionBasedCoordinateForce><StrangeForce name=\"odd\"/><StrangeForce name=\"off\">"
               "<appliesForce>false</appliesForce></StrangeForce>"));
  EXPECT_THAT(model.missing_forces, testing::ElementsAre("c", "odd"));
  EXPECT_THAT(model.unsupported, testing::Contains(testing::HasSubstr("'2*nothing' is not understood")));
}

/// A bushing turned about all axes does the work of its angles: its moment on a rod that hangs by three angles.
TEST(PassiveForces, a_bushings_moments_do_the_work_of_its_angles) {
  const Model model = model_from(
      document(set("BodySet", body("rod")) +
               set("JointSet", joint("GimbalJoint", "hinge", "/ground", "rod",
                                     coordinate("a") + coordinate("b") + coordinate("c"))) +
               set("ForceSet",
                   "<BushingForce name=\"s\"><socket_frame1>/ground</socket_frame1><socket_frame2>/bodyset/rod"
                   "</socket_frame2><rotational_stiffness>10 20 30</rotational_stiffness></BushingForce>")));
  Skeleton skeleton(model);
  const Eigen::Vector3d angles(0.4, -0.7, 0.9);
  skeleton.place(angles);
  const Eigen::VectorXd moments =
      skeleton.generalized_forces(passive_forces(skeleton, angles, Eigen::VectorXd::Zero(3)));
  EXPECT_LT((moments - Eigen::Vector3d(-4, 14, -27)).norm(), 1e-9);
}

TEST(StaticOptimization, what_a_spring_does_is_not_asked_of_the_actuator) {
  const auto moment = [](const std::string& spring) {
    const Model model = model_from(pendulum(spring));
    CoordinateMotion motion;
    motion.values = Eigen::MatrixXd::Constant(20, 1, 0.5);
    for (int i = 0; i < 20; ++i) motion.times.push_back(0.01 * i);
    return inverse_dynamics(model, motion, {}, {10}).values(0, 0);
  };
  EXPECT_NEAR(moment("<SpringGeneralizedForce name=\"s\"><coordinate>swing</coordinate><stiffness>7</stiffness>"
                     "</SpringGeneralizedForce>"),
              moment("") + 7 * 0.5, 1e-9);
}

}  // namespace gracilis::opensim
