#include "opensim/model_texts.hpp"

#include <gracilis/opensim/static_optimization/muscle_curves.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace gracilis::opensim {

/// A piece of a curve by Bernstein's polynomials.
static Real bernstein(const Eigen::Vector<Real, 6>& points, Real u) {
  const Real binomial[6] = {1, 5, 10, 10, 5, 1};
  Real sum = 0;
  for (int i = 0; i < 6; ++i) sum += binomial[i] * std::pow(u, i) * std::pow(1 - u, 5 - i) * points[i];
  return sum;
}

TEST(BezierCurve, is_the_polynomial_of_its_control_points) {
  BezierCurve curve;
  add_corner(curve, {0, 0, 0.1}, {1, 1, 3}, 0.6);
  for (const Real u : {0.0, 0.1, 0.37, 0.8, 1.0})
    EXPECT_NEAR(value(curve, bernstein(curve.x.col(0), u)), bernstein(curve.y.col(0), u), 1e-14);
  // The lines meet at x = 2 / 2.9; with curviness 1 the middle control points lie at 0.9 of the way there.
  const Real corner = 2 / 2.9, c = 0.1 + 0.8 * 0.6;
  EXPECT_NEAR(curve.x(1, 0), c * corner, 1e-15);
  EXPECT_NEAR(curve.y(3, 0), 1 + c * (0.1 * corner - 1), 1e-15);
}

TEST(BezierCurve, has_the_slopes_it_is_given_and_goes_on_straight) {
  BezierCurve curve;
  add_corner(curve, {0, 0, 0.1}, {1, 1, 3}, 0.6);
  EXPECT_NEAR(slope(curve, 1e-9), 0.1, 1e-4);
  EXPECT_NEAR(slope(curve, 1 - 1e-9), 3, 1e-4);
  EXPECT_NEAR(value(curve, 2), 1 + 3, 1e-15);
  EXPECT_NEAR(value(curve, -1), -0.1, 1e-15);
  const Real h = 1e-6;
  EXPECT_NEAR(slope(curve, 0.5), (value(curve, 0.5 + h) - value(curve, 0.5 - h)) / (2 * h), 1e-8);
}

static Muscle of_type(const std::string& type, const std::string& more = "") {
  const std::string muscle = "<" + type + " name=\"m\"><GeometryPath>" +
                             set("PathPointSet", point("/ground", "0.3 0 0") + point("/bodyset/rod", "0 -0.4 0")) +
                             "</GeometryPath>" + more + "</" + type + ">";
  const Model model = model_from(pendulum(muscle));
  EXPECT_THAT(model.unsupported, testing::IsEmpty());
  return model.muscles.at(0);
}

TEST(MuscleCurves, of_millards_muscles_go_through_what_shapes_them) {
  const Muscle muscle = of_type("Millard2012EquilibriumMuscle");
  EXPECT_NEAR(force_length_factor(muscle, 1), 1, 1e-12);
  EXPECT_NEAR(force_length_factor(muscle, 0.4441), 0, 1e-12);
  EXPECT_NEAR(force_length_factor(muscle, 1.8123), 0, 1e-12);
  EXPECT_NEAR(force_length_factor(muscle, (0.4441 + 0.73) / 2), (1 - 0.8616 * 0.22) / 2, 1e-12);
  EXPECT_NEAR(force_velocity_factor(muscle, -1), 0, 1e-12);
  EXPECT_NEAR(force_velocity_factor(muscle, 0), 1, 1e-12);
  EXPECT_NEAR(force_velocity_factor(muscle, 1), 1.4, 1e-12);
  EXPECT_NEAR((force_velocity_factor(muscle, 1e-7) - force_velocity_factor(muscle, -1e-7)) / 2e-7, 5, 1e-4);
  EXPECT_NEAR(passive_factor(muscle, 1), 0, 1e-12);
  EXPECT_NEAR(passive_factor(muscle, 1.7), 1, 1e-12);
  EXPECT_NEAR(passive_factor(muscle, 1.8), 1 + 0.1 * 2 / 0.7, 1e-12);
  EXPECT_NEAR(tendon_factor(muscle, 1), 0, 1e-12);
  EXPECT_NEAR(tendon_factor(muscle, 1.049), 1, 1e-12);
  EXPECT_NEAR(tendon_factor(muscle, 1.06), 1 + 0.011 * 1.375 / 0.049, 1e-12);
}

TEST(MuscleCurves, follow_the_parameters_of_the_file) {
  const Muscle millard = of_type(
      "Millard2012EquilibriumMuscle",
      "<fiber_damping>0</fiber_damping><ActiveForceLengthCurve><minimum_value>0.2</minimum_value>"
      "</ActiveForceLengthCurve><TendonForceLengthCurve><strain_at_one_norm_force>0.1</strain_at_one_norm_force>"
      "</TendonForceLengthCurve><FiberForceLengthCurve><strain_at_one_norm_force>0.5</strain_at_one_norm_force>"
      "</FiberForceLengthCurve>");
  EXPECT_NEAR(tendon_factor(millard, 1.1), 1, 1e-12);
  EXPECT_NEAR(passive_factor(millard, 1.5), 1, 1e-12);
  EXPECT_NEAR(force_length_factor(millard, 2), 0.2, 1e-12);  // kept, for without damping zero would be singular
  const Muscle thelen = of_type("Thelen2003Muscle",
                                "<FmaxTendonStrain>0.05</FmaxTendonStrain><FmaxMuscleStrain>0.7</FmaxMuscleStrain>"
                                "<KshapePassive>4</KshapePassive>");
  EXPECT_NEAR(tendon_factor(thelen, 1.05), 1, 1e-12);
  EXPECT_NEAR(tendon_factor(thelen, 1 + 0.609 * 0.05), 0.33, 2e-3);  // the paper's rounded end of the toe
  EXPECT_NEAR(passive_factor(thelen, 1.7), 1, 1e-12);
  EXPECT_NEAR(passive_factor(thelen, 1.35), (std::exp(2.0) - 1) / (std::exp(4.0) - 1), 1e-12);
  EXPECT_EQ(passive_factor(thelen, 0.9), 0);
  const Muscle de_groote = of_type("DeGrooteFregly2016Muscle",
                                   "<tendon_strain_at_one_norm_force>0.08</tendon_strain_at_one_norm_force>"
                                   "<active_force_width_scale>2</active_force_width_scale>");
  EXPECT_NEAR(tendon_factor(de_groote, 1.08), 1, 1e-12);
  EXPECT_NEAR(tendon_factor(de_groote, 1), 0, 1e-12);
  EXPECT_NEAR(passive_factor(de_groote, 1.6), 1, 1e-12);
  EXPECT_NEAR(passive_factor(de_groote, 0.2), 0, 1e-12);
  EXPECT_NEAR(force_length_factor(de_groote, 1.4), force_length_factor(of_type("DeGrooteFregly2016Muscle"), 1.2),
              1e-12);
}

TEST(MuscleCurves, that_do_not_fit_are_named_and_left) {
  const std::string muscle =
      "<Millard2012EquilibriumMuscle name=\"m\"><GeometryPath>" +
      set("PathPointSet", point("/ground", "0.3 0 0") + point("/bodyset/rod", "0 -0.4 0")) +
      "</GeometryPath><ForceVelocityCurve><isometric_slope>0.5</isometric_slope></ForceVelocityCurve>"
      "</Millard2012EquilibriumMuscle>";
  const Model model = model_from(pendulum(muscle));
  EXPECT_THAT(model.unsupported, testing::ElementsAre(testing::HasSubstr("force-velocity curve has slopes")));
  EXPECT_NEAR(force_velocity_factor(model.muscles.at(0), 0), 1, 1e-12);
}

TEST(MuscleCurves, thelens_largest_speed_grows_with_activation) {
  const Muscle muscle = of_type("Thelen2003Muscle");
  EXPECT_NEAR(force_velocity_factor(muscle, -0.3, 0.2), force_velocity_factor(muscle, -0.3 / 0.4), 1e-14);
}

}  // namespace gracilis::opensim
