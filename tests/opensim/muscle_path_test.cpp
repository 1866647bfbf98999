#include "opensim/model_texts.hpp"

#include <gracilis/opensim/muscle_path.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis::opensim {

static PathMeasure measure(const Model& model, const std::vector<Real>& values, std::size_t muscle = 0) {
  Skeleton skeleton(model);
  Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  apply_couplers(model, q);
  skeleton.place(q);
  return measure_path(skeleton, model.muscles[muscle].path, q);
}

/// -dL/dq by central differences.
static Eigen::VectorXd differences(const Model& model, const std::vector<Real>& at, std::size_t muscle = 0) {
  Eigen::VectorXd arms(static_cast<Eigen::Index>(at.size()));
  const Real step = 1e-5;
  for (std::size_t i = 0; i < at.size(); ++i) {
    std::vector<Real> before = at, after = at;
    before[i] -= step;
    after[i] += step;
    arms[static_cast<Eigen::Index>(i)] =
        (measure(model, before, muscle).length - measure(model, after, muscle).length) / (2 * step);
  }
  return arms;
}

TEST(MusclePath, a_straight_path_on_a_hinge_obeys_the_law_of_cosines) {
  // From (0.3, 0) on the ground to a point 0.4 below the hinge: the angle between them is 90 degrees plus the swing.
  const Model model =
      model_from(pendulum(muscle("m", point("/ground", "0.3 0 0") + point("/bodyset/rod", "0 -0.4 0"))));
  for (const Real swing : {0.0, 0.5, -0.7}) {
    const Real angle = pi / 2 - swing, length = std::sqrt(0.09 + 0.16 - 0.24 * std::cos(angle));
    const PathMeasure m = measure(model, {swing});
    EXPECT_NEAR(m.length, length, 1e-14);
    EXPECT_NEAR(m.moment_arms[0], 0.12 * std::sin(angle) / length, 1e-14);  // shortening swings the rod forward
  }
}

static const char* conditional =
    "<ConditionalPathPoint name=\"c\"><socket_parent_frame>/ground</socket_parent_frame><location>1 0 0</location>"
    "<socket_coordinate>/jointset/hinge/swing</socket_coordinate><range>0 1</range></ConditionalPathPoint>";

TEST(MusclePath, a_conditional_point_is_there_within_its_range_only) {
  const Model model =
      model_from(pendulum(muscle("m", point("/ground", "0 1 0") + conditional + point("/ground", "0 -1 0"))));
  EXPECT_NEAR(measure(model, {0.5}).length, 2 * std::sqrt(2), 1e-14);
  EXPECT_NEAR(measure(model, {-0.5}).length, 2, 1e-14);
}

TEST(MusclePath, a_moving_point_works_with_its_coordinate) {
  const std::string moving =
      "<MovingPathPoint name=\"p\"><socket_parent_frame>/bodyset/rod</socket_parent_frame>"
      "<socket_x_coordinate>/jointset/hinge/swing</socket_x_coordinate><x_location><SimmSpline><x>-1 0 1 2</x>"
      "<y>0.1 0 0.1 0.4</y></SimmSpline></x_location><y_location><Constant><value>-0.4</value></Constant></y_location>"
      "</MovingPathPoint>";
  const Model model = model_from(pendulum(muscle("m", point("/ground", "0.3 0 0") + moving)));
  EXPECT_NEAR(measure(model, {0}).length, 0.5, 1e-14);
  for (const Real swing : {0.3, -0.2})
    EXPECT_NEAR(measure(model, {swing}).moment_arms[0], differences(model, {swing})[0], 1e-9);
}

static std::string cylinder(const std::string& more = "") {
  return set("WrapObjectSet",
             "<WrapCylinder name=\"around\"><radius>0.1</radius><length>1</length>" + more + "</WrapCylinder>");
}
static const char* around = "<PathWrap name=\"w\"><wrap_object>around</wrap_object></PathWrap>";

TEST(MusclePath, a_pulley_holds_the_moment_arm_at_its_radius) {
  const Model model =
      model_from(pendulum(muscle("m", point("/ground", "0.3 0 0") + point("/bodyset/rod", "0.05 -0.4 0"), "", around),
                          cylinder("<quadrant>+x</quadrant>")));
  // Far enough that the line would cut the pulley.
  const PathMeasure m = measure(model, {-1.4});
  EXPECT_NEAR(m.moment_arms[0], 0.1, 1e-12);
  EXPECT_NEAR(m.moment_arms[0], differences(model, {-1.4})[0], 1e-9);
}

TEST(MusclePath, a_slanted_path_around_a_cylinder_is_straight_when_unrolled) {
  const Model model = model_from(pendulum(
      muscle("m", point("/ground", "-0.3 0.05 0") + point("/ground", "0.3 0.05 0.2"), "", around), cylinder()));
  const Real distance = std::hypot(0.3, 0.05), tangent = std::sqrt(distance * distance - 0.01);
  // The angle between the two points seen from the axis, less those to the points of touch.
  const Real angle = pi - 2 * std::atan2(0.05, 0.3) - 2 * std::acos(0.1 / distance);
  EXPECT_NEAR(measure(model, {0}).length, std::hypot(2 * tangent + 0.1 * angle, 0.2), 1e-14);
}

TEST(MusclePath, a_path_is_held_on_the_side_that_the_quadrant_names) {
  const std::string points = point("/ground", "-0.3 0.05 0") + point("/ground", "0.3 0.05 0");
  const Model below = model_from(pendulum(muscle("m", points, "", around), cylinder("<quadrant>-y</quadrant>")));
  const Model above = model_from(pendulum(muscle("m", points, "", around), cylinder("<quadrant>+y</quadrant>")));
  const Real distance = std::hypot(0.3, 0.05), tangent = std::sqrt(distance * distance - 0.01);
  const Real touch = 2 * std::acos(0.1 / distance), between = pi - 2 * std::atan2(0.05, 0.3);
  EXPECT_NEAR(measure(above, {0}).length, 2 * tangent + 0.1 * (between - touch), 1e-14);
  EXPECT_NEAR(measure(below, {0}).length, 2 * tangent + 0.1 * (2 * pi - between - touch), 1e-14);
}

TEST(MusclePath, a_path_beyond_the_cylinders_length_runs_straight) {
  const Model model = model_from(
      pendulum(muscle("m", point("/ground", "-0.3 0.05 2") + point("/ground", "0.3 0.05 2"), "", around), cylinder()));
  EXPECT_NEAR(measure(model, {0}).length, 0.6, 1e-15);
}

TEST(MusclePath, a_sphere_is_rounded_on_a_great_circle_and_flagged) {
  const std::string sphere = set("WrapObjectSet", "<WrapSphere name=\"around\"><radius>0.1</radius></WrapSphere>");
  const Model model = model_from(
      pendulum(muscle("m", point("/ground", "-0.3 0.05 0") + point("/ground", "0.3 0.05 0"), "", around), sphere));
  const Real distance = std::hypot(0.3, 0.05), tangent = std::sqrt(distance * distance - 0.01);
  const Real angle = pi - 2 * std::atan2(0.05, 0.3) - 2 * std::acos(0.1 / distance);
  EXPECT_NEAR(measure(model, {0}).length, 2 * tangent + 0.1 * angle, 1e-14);
  EXPECT_TRUE(model.muscles[0].path.approximate);
}

TEST(MusclePath, a_coupled_coordinate_works_through_the_one_it_depends_on) {
  const std::string coupler =
      "<CoordinateCouplerConstraint name=\"c\"><coupled_coordinates_function><LinearFunction><coefficients>2 0.1"
      "</coefficients></LinearFunction></coupled_coordinates_function><independent_coordinate_names>swing"
      "</independent_coordinate_names><dependent_coordinate_name>bend</dependent_coordinate_name>"
      "</CoordinateCouplerConstraint>";
  const Model model = model_from(document(
      set("BodySet", body("rod") + body("tip")) +
      set("JointSet", joint("PinJoint", "hinge", "/ground", "rod", coordinate("swing")) +
                          joint("PinJoint", "knee", "/bodyset/rod", "tip", coordinate("bend"), "", "0 -0.5 0")) +
      set("ConstraintSet", coupler) +
      set("ForceSet", muscle("m", point("/ground", "0.3 0 0") + point("/bodyset/tip", "0.1 -0.4 0")))));
  const PathMeasure m = measure(model, {0.3, 0});
  EXPECT_EQ(m.moment_arms[1], 0);
  EXPECT_NEAR(m.moment_arms[0], differences(model, {0.3, 0})[0], 1e-9);
}

TEST(MusclePath, a_function_based_path_is_its_polynomial) {
  const Model model = model_from(pendulum(
      "<Millard2012EquilibriumMuscle name=\"m\"><path><FunctionBasedPath><coordinate_paths>/jointset/hinge/swing"
      "</coordinate_paths><length_function><MultivariatePolynomialFunction><dimension>1</dimension><order>2</order>"
      "<coefficients>0.5 -0.1 0.02</coefficients></MultivariatePolynomialFunction></length_function>"
      "</FunctionBasedPath></path></Millard2012EquilibriumMuscle>"));
  const PathMeasure m = measure(model, {0.5});
  EXPECT_NEAR(m.length, 0.5 - 0.05 + 0.005, 1e-15);
  EXPECT_NEAR(m.moment_arms[0], 0.1 - 0.02, 1e-15);
}

TEST(MusclePath, moment_arms_of_the_walking_model_are_the_slopes_of_its_lengths) {
  GRACILIS_NEEDS_DATA("opensim");
  const Model model = read_model(data_root() / "opensim/subject01_simbody_adjusted_StaticOp.osim");
  std::vector<Real> q;
  for (const Coordinate& coordinate : model.coordinates) q.push_back(coordinate.default_value * 0.7 + 0.01);
  int judged = 0;
  for (std::size_t i = 0; i < model.muscles.size(); i += 7, ++judged)
    EXPECT_LT((measure(model, q, i).moment_arms - differences(model, q, i)).cwiseAbs().maxCoeff(), 1e-8)
        << model.muscles[i].name;
  EXPECT_GT(judged, 10);
}

}  // namespace gracilis::opensim
