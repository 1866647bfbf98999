#include <gracilis/opensim/functions/function.hpp>
#include <gracilis/opensim/functions/smoothing_spline.hpp>
#include <gracilis/opensim/kinematics/quintic_spline.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace gracilis::opensim {

TEST(OpenSimFunction, a_simm_spline_through_points_of_a_cubic_is_that_cubic) {
  const auto cubic = [](Real x) { return 2 - x + 3 * x * x - 0.5 * x * x * x; };
  std::vector<Real> x = {-2, -1.5, 0, 0.5, 3}, y;
  for (const Real each : x) y.push_back(cubic(each));
  const Function spline = simm_spline(x, y);
  for (const Real at : {-2.0, -1.9, -0.3, 0.2, 2.7, 3.0}) {
    EXPECT_NEAR(value(spline, {at}), cubic(at), 1e-12) << at;
    EXPECT_NEAR(derivative(spline, {at}, {0}), -1 + 6 * at - 1.5 * at * at, 1e-11) << at;
  }
  EXPECT_NEAR(derivative(spline, {0.2}, {0, 0}), 6 - 3 * 0.2, 1e-11);
}

TEST(OpenSimFunction, a_simm_spline_is_straight_beyond_its_ends) {
  const Function spline = simm_spline({0, 1, 2, 3}, {0, 1, 8, 27});
  EXPECT_NEAR(value(spline, {4}), 27 + 27, 1e-12);  // the cube's slope at 3 is 27
  EXPECT_NEAR(value(spline, {-1}), 0, 1e-12);
  EXPECT_NEAR(derivative(spline, {5}, {0}), 27, 1e-12);
  EXPECT_EQ(derivative(spline, {5}, {0, 0}), 0);
}

TEST(OpenSimFunction, splines_through_two_and_three_points_are_a_line_and_a_parabola) {
  EXPECT_NEAR(value(simm_spline({0, 2}, {1, 5}), {0.5}), 2, 1e-15);
  EXPECT_NEAR(value(simm_spline({0, 1, 3}, {0, 1, 9}), {2}), 4, 1e-14);
}

TEST(OpenSimFunction, a_natural_spline_has_no_curvature_at_its_ends) {
  const Function spline = natural_spline({0, 1, 2}, {0, 1, 0});
  EXPECT_NEAR(derivative(spline, {0}, {0, 0}), 0, 1e-14);
  EXPECT_NEAR(value(spline, {0.5}), 1.5 * 0.5 - 0.5 * 0.125, 1e-14);  // 3/2 x - 1/2 x^3
}

TEST(OpenSimFunction, a_sine_has_its_derivatives) {
  const Function f = sine(2, 3, 0.5, 7);
  EXPECT_NEAR(value(f, {0.4}), 7 + 2 * std::sin(1.7), 1e-15);
  EXPECT_NEAR(derivative(f, {0.4}, {0}), 6 * std::cos(1.7), 1e-14);
  EXPECT_NEAR(derivative(f, {0.4}, {0, 0}), -18 * std::sin(1.7), 1e-14);
}

/// Points of a wave at uneven places.
static void wave(std::vector<Real>& x, std::vector<Real>& y, int count) {
  for (int i = 0; i < count; ++i) {
    x.push_back(0.1 * i + 0.03 * (i % 3));
    y.push_back(std::sin(2 * x.back()) + 0.3 * x.back());
  }
}

TEST(OpenSimFunction, a_gcv_spline_of_half_order_2_is_the_natural_cubic) {
  std::vector<Real> x, y;
  wave(x, y, 40);
  const Function spline = smoothing_spline(x, y, {}), cubic = natural_spline(x, y);
  for (const Real at : {-0.5, 0.0, 0.77, 1.5, 3.9, 5.0}) {
    EXPECT_NEAR(value(spline, {at}), value(cubic, {at}), 1e-9) << at;
    EXPECT_NEAR(derivative(spline, {at}, {0, 0}), derivative(cubic, {at}, {0, 0}), 1e-6) << at;
  }
}

TEST(OpenSimFunction, a_gcv_spline_of_half_order_3_is_the_quintic_one) {
  std::vector<Real> x, y;
  wave(x, y, 40);
  SmoothingSplineSettings settings;
  settings.half_order = 3;
  const Function spline = smoothing_spline(x, y, settings);
  const QuinticSpline quintic = quintic_spline(x, Eigen::VectorXd::Map(y.data(), 40));
  for (const Real at : {0.0, 0.011, 0.77, 1.5, 3.9}) EXPECT_NEAR(value(spline, {at}), evaluate(quintic, at)[0], 1e-8);
}

TEST(OpenSimFunction, a_gcv_spline_finds_the_wave_behind_the_noise) {
  std::vector<Real> x, y;
  wave(x, y, 80);
  std::vector<Real> noisy = y;
  for (std::size_t i = 0; i < y.size(); ++i) noisy[i] += 0.1 * std::sin(1000.0 * static_cast<Real>(i * i));
  for (const Real variance : {-1.0, 0.005}) {
    SmoothingSplineSettings settings;
    settings.error_variance = variance;
    const Function spline = smoothing_spline(x, noisy, settings);
    Real before = 0, after = 0;
    for (std::size_t i = 0; i < y.size(); ++i) {
      before += (noisy[i] - y[i]) * (noisy[i] - y[i]);
      after += std::pow(value(spline, {x[i]}) - y[i], 2);
    }
    EXPECT_LT(after, 0.5 * before) << variance;
  }
}

TEST(OpenSimFunction, a_linear_function_of_two_arguments_has_its_coefficients_as_slopes) {
  Function function = linear(2, 0);
  function.coefficients = {2, 3, 5};
  function.scale = 10;
  EXPECT_EQ(value(function, {1, 1}), 100);
  EXPECT_EQ(derivative(function, {1, 1}, {1}), 30);
  EXPECT_EQ(derivative(function, {1, 1}, {0, 1}), 0);
}

TEST(OpenSimFunction, a_polynomial_begins_with_its_highest_power) {
  Function function;
  function.kind = Function::Kind::polynomial;
  function.coefficients = {1, -2, 3};
  EXPECT_EQ(value(function, {2}), 3);
  EXPECT_EQ(derivative(function, {2}, {0}), 2);
  EXPECT_EQ(derivative(function, {2}, {0, 0}), 2);
}

TEST(OpenSimFunction, a_multivariate_polynomial_counts_its_last_argument_first) {
  EXPECT_THAT(monomials(2, 1), testing::ElementsAre(std::vector{0, 0}, std::vector{0, 1}, std::vector{1, 0}));
  Function function;
  function.kind = Function::Kind::multivariate;
  function.dimension = 2;
  function.order = 2;
  function.coefficients = {1, 2, 3, 4, 5, 6};  // 1 + 2 y + 3 y² + 4 x + 5 x y + 6 x²
  EXPECT_EQ(value(function, {2, 3}), 1 + 6 + 27 + 8 + 30 + 24);
  EXPECT_EQ(derivative(function, {2, 3}, {0}), 4 + 15 + 24);
  EXPECT_EQ(derivative(function, {2, 3}, {0, 1}), 5);
}

TEST(OpenSimFunction, a_piecewise_linear_function_joins_its_points) {
  const Function function = piecewise_linear({0, 1, 3}, {0, 2, 0});
  EXPECT_EQ(value(function, {0.5}), 1);
  EXPECT_EQ(value(function, {2}), 1);
  EXPECT_EQ(value(function, {4}), -1);
  EXPECT_EQ(derivative(function, {2}, {0}), -1);
}

}  // namespace gracilis::opensim
