#include "opensim/model_texts.hpp"

#include <gracilis/opensim/paths/muscle_path.hpp>

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

TEST(MusclePath, a_moving_point_stays_beyond_the_range_of_its_coordinate) {
  const std::string moving =
      "<MovingPathPoint name=\"p\"><socket_parent_frame>/bodyset/rod</socket_parent_frame>"
      "<socket_x_coordinate>/jointset/hinge/swing</socket_x_coordinate><x_location><LinearFunction><coefficients>0.2 "
      "0.1"
      "</coefficients></LinearFunction></x_location><y_location><Constant><value>-0.4</value></Constant></y_location>"
      "</MovingPathPoint>";
  const std::string narrow = "<Coordinate name=\"swing\"><range>-0.5 0.6</range></Coordinate>";
  const Model model = model_from(document(set("BodySet", body("rod")) +
                                          set("JointSet", joint("PinJoint", "hinge", "/ground", "rod", narrow)) +
                                          set("ForceSet", muscle("m", point("/ground", "0.3 0 0") + moving))));
  const PathPoint& point = model.muscles[0].path.points[1];
  const auto x_at = [&](Real swing) { return location_of(model, point, Eigen::VectorXd::Constant(1, swing)).x(); };
  EXPECT_NEAR(x_at(0.25), 0.15, 1e-15);
  EXPECT_NEAR(x_at(1), 0.22, 1e-15);
  EXPECT_NEAR(x_at(-2), 0, 1e-15);
  // Its moment arm is the slope of its length, within the range and beyond.
  for (const Real swing : {0.3, 1.0, -0.9})
    EXPECT_NEAR(measure(model, {swing}).moment_arms[0], differences(model, {swing})[0], 1e-9) << swing;
}

static std::string cylinder(const std::string& more = "") {
  return set("WrapObjectSet",
             "<WrapCylinder name=\"around\"><radius>0.1</radius><length>1</length>" + more + "</WrapCylinder>");
}
static const char* around_cylinder = "<PathWrap name=\"w\"><wrap_object>around</wrap_object></PathWrap>";

TEST(MusclePath, a_pulley_holds_the_moment_arm_at_its_radius) {
  const Model model = model_from(
      pendulum(muscle("m", point("/ground", "0.3 0 0") + point("/bodyset/rod", "0.05 -0.4 0"), "", around_cylinder),
               cylinder("<quadrant>+x</quadrant>")));
  // Far enough that the line would cut the pulley.
  const PathMeasure m = measure(model, {-1.4});
  EXPECT_NEAR(m.moment_arms[0], 0.1, 1e-12);
  EXPECT_NEAR(m.moment_arms[0], differences(model, {-1.4})[0], 1e-9);
}

TEST(MusclePath, a_slanted_path_around_a_cylinder_is_straight_when_unrolled) {
  const Model model = model_from(
      pendulum(muscle("m", point("/ground", "-0.3 0.05 0") + point("/ground", "0.3 0.05 0.2"), "", around_cylinder),
               cylinder()));
  const Real distance = std::hypot(0.3, 0.05), tangent = std::sqrt(distance * distance - 0.01);
  // The angle between the two points seen from the axis, less those to the points of touch.
  const Real angle = pi - 2 * std::atan2(0.05, 0.3) - 2 * std::acos(0.1 / distance);
  EXPECT_NEAR(measure(model, {0}).length, std::hypot(2 * tangent + 0.1 * angle, 0.2), 1e-14);
}

TEST(MusclePath, a_path_is_held_on_the_side_that_the_quadrant_names) {
  const std::string points = point("/ground", "-0.3 0.05 0") + point("/ground", "0.3 0.05 0");
  const Model below =
      model_from(pendulum(muscle("m", points, "", around_cylinder), cylinder("<quadrant>-y</quadrant>")));
  const Model above =
      model_from(pendulum(muscle("m", points, "", around_cylinder), cylinder("<quadrant>+y</quadrant>")));
  const Real distance = std::hypot(0.3, 0.05), tangent = std::sqrt(distance * distance - 0.01);
  const Real touch = 2 * std::acos(0.1 / distance), between = pi - 2 * std::atan2(0.05, 0.3);
  EXPECT_NEAR(measure(above, {0}).length, 2 * tangent + 0.1 * (between - touch), 1e-14);
  EXPECT_NEAR(measure(below, {0}).length, 2 * tangent + 0.1 * (2 * pi - between - touch), 1e-14);
}

TEST(MusclePath, a_path_beyond_the_cylinders_length_runs_straight) {
  const Model model = model_from(pendulum(
      muscle("m", point("/ground", "-0.3 0.05 2") + point("/ground", "0.3 0.05 2"), "", around_cylinder), cylinder()));
  EXPECT_NEAR(measure(model, {0}).length, 0.6, 1e-15);
}

TEST(MusclePath, several_wraps_are_flagged) {
  const std::string line = point("/ground", "-0.3 0.05 2") + point("/ground", "0.3 0.05 2");
  const std::string again = "<PathWrap name=\"v\"><wrap_object>around</wrap_object></PathWrap>";
  EXPECT_FALSE(model_from(pendulum(muscle("m", line, "", around_cylinder), cylinder())).muscles[0].path.approximate);
  EXPECT_TRUE(
      model_from(pendulum(muscle("m", line, "", around_cylinder + again), cylinder())).muscles[0].path.approximate);
}

TEST(MusclePath, a_sphere_is_rounded_on_a_great_circle_and_flagged) {
  const std::string sphere = set("WrapObjectSet", "<WrapSphere name=\"around\"><radius>0.1</radius></WrapSphere>");
  const Model model = model_from(pendulum(
      muscle("m", point("/ground", "-0.3 0.05 0") + point("/ground", "0.3 0.05 0"), "", around_cylinder), sphere));
  const Real distance = std::hypot(0.3, 0.05), tangent = std::sqrt(distance * distance - 0.01);
  const Real angle = pi - 2 * std::atan2(0.05, 0.3) - 2 * std::acos(0.1 / distance);
  EXPECT_NEAR(measure(model, {0}).length, 2 * tangent + 0.1 * angle, 1e-14);
  EXPECT_TRUE(model.muscles[0].path.approximate);
}

/// From left to right past an object at the origin.
static Model model_past(const std::string& object, const std::string& from, const std::string& to) {
  return model_from(pendulum(muscle("m", point("/ground", from) + point("/ground", to), "", around_cylinder),
                             set("WrapObjectSet", object)));
}

TEST(MusclePath, an_ellipsoid_with_equal_radii_is_a_sphere) {
  const std::string from = "-0.3 0.02 0.03", to = "0.25 -0.03 0.05";
  const Model ball = model_past("<WrapSphere name=\"around\"><radius>0.1</radius></WrapSphere>", from, to);
  const Model round =
      model_past("<WrapEllipsoid name=\"around\"><dimensions>0.1 0.1 0.1</dimensions></WrapEllipsoid>", from, to);
  EXPECT_NEAR(measure(round, {0}).length, measure(ball, {0}).length, 1e-9);
  EXPECT_TRUE(round.muscles[0].path.approximate);
}

/// The ellipse x²/p² + y²/q² = 1 rounded above from (-d, 0) to (d, 0), by adding up chords.
static Real length_over_ellipse(Real p, Real q, Real d) {
  // The tangent from (d, 0) touches where cos t = p / d.
  const Real touch = std::acos(p / d);
  Real length = 2 * std::hypot(d - p * std::cos(touch), q * std::sin(touch));
  const int parts = 100000;
  const Real step = (pi - 2 * touch) / parts;
  for (int i = 0; i < parts; ++i) {
    const Real t = touch + i * step, next = t + step;
    length += std::hypot(p * (std::cos(next) - std::cos(t)), q * (std::sin(next) - std::sin(t)));
  }
  return length;
}

TEST(MusclePath, an_ellipsoid_is_rounded_where_it_is_thinnest_or_on_its_side) {
  const std::string begin = "<WrapEllipsoid name=\"around\"><dimensions>0.1 0.05 0.2</dimensions>";
  const Model free = model_past(begin + "</WrapEllipsoid>", "-0.3 0 0", "0.3 0 0");
  EXPECT_NEAR(measure(free, {0}).length, length_over_ellipse(0.1, 0.05, 0.3), 1e-8);
  const Model far = model_past(begin + "<quadrant>+y</quadrant></WrapEllipsoid>", "-0.3 0 0", "0.3 0 0");
  EXPECT_NEAR(measure(far, {0}).length, length_over_ellipse(0.1, 0.05, 0.3), 1e-8);
  const Model past = model_past(begin + "</WrapEllipsoid>", "-0.3 0.06 0", "0.3 0.06 0");
  EXPECT_NEAR(measure(past, {0}).length, 0.6, 1e-14);
}

TEST(MusclePath, a_path_through_a_torus_bends_about_its_tube) {
  const Model model = model_past(
      "<WrapTorus name=\"around\"><inner_radius>0.05</inner_radius><outer_radius>0.2</outer_radius></WrapTorus>",
      "0.18 0 -0.3", "0.18 0 0.3");
  const Real distance = std::hypot(0.02, 0.3), angle = 2 * std::atan2(0.3, 0.02) - 2 * std::acos(0.05 / distance);
  EXPECT_NEAR(measure(model, {0}).length, 2 * std::sqrt(distance * distance - 0.0025) + 0.05 * angle, 1e-9);
  EXPECT_TRUE(model.muscles[0].path.approximate);
}

TEST(MusclePath, an_obstacle_is_passed_in_its_sense_until_nothing_touches) {
  const auto length = [](const std::string& hand, Real height) {
    const std::string y = std::to_string(height);
    return measure(model_past("<WrapCylinderObst name=\"around\"><radius>0.125</radius><wrapDirection>" + hand +
                                  "</wrapDirection></WrapCylinderObst>",
                              "-0.3 " + y + " 0", "0.3 " + y + " 0"),
                   {0})
        .length;
  };
  // OpenSim wraps around 0.8 of the radius.
  const auto expected = [](Real height, Real between) {
    const Real distance = std::hypot(0.3, height);
    return 2 * std::sqrt(distance * distance - 0.01) + 0.1 * (between - 2 * std::acos(0.1 / distance));
  };
  const Real above = pi - 2 * std::atan2(0.05, 0.3), below = pi + 2 * std::atan2(0.05, 0.3);
  EXPECT_NEAR(length("lefthand", 0.05), expected(0.05, above), 1e-9);
  EXPECT_NEAR(length("righthand", 0.05), expected(0.05, below), 1e-9);
  EXPECT_NEAR(length("righthand", 0.5), expected(0.5, pi + 2 * std::atan2(0.5, 0.3)), 1e-6);
  EXPECT_NEAR(length("righthand", -0.5), 0.6, 1e-14);
}

TEST(MusclePath, a_double_obstacle_is_two_cylinders_on_two_bodies) {
  const Model model = model_past(
      "<WrapDoubleCylinderObst name=\"around\"><radiusUcyl>0.125</radiusUcyl><radiusVcyl>0.125</radiusVcyl>"
      "<wrapUcylDirection>lefthand</wrapUcylDirection><wrapVcylDirection>lefthand</wrapVcylDirection>"
      "<wrapVcylHomeBodyName>ground</wrapVcylHomeBodyName><translationVcyl>0.4 0 0</translationVcyl>"
      "</WrapDoubleCylinderObst>",
      "-0.3 0 0", "0.7 0 0");
  ASSERT_EQ(model.wrap_objects.size(), 2u);
  EXPECT_EQ(model.wrap_objects[0].body, 1);
  EXPECT_EQ(model.wrap_objects[1].body, 0);
  // Over both: two tangents of 0.2828, a quarter less acos(1/3) on each, and 0.4 between the tops.
  const Real touch = std::acos(0.1 / 0.3);
  EXPECT_NEAR(measure(model, {0}).length, 2 * std::sqrt(0.08) + 0.4 + 2 * 0.1 * (pi / 2 - touch), 2e-4);
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
