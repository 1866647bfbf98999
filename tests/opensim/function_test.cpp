#include <gracilis/opensim/function.hpp>

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
