#include "io/test_files.hpp"

#include <gracilis/opensim/kinematics/low_pass.hpp>
#include <gracilis/opensim/kinematics/quintic_spline.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis::opensim {

/// Samples of f at n times, `step` apart but for a wobble.
template <class F>
static std::pair<std::vector<Real>, Eigen::MatrixXd> samples(int n, Real step, Real wobble, F f) {
  std::vector<Real> times;
  Eigen::MatrixXd values(n, 1);
  for (int i = 0; i < n; ++i) {
    times.push_back(step * (i + (i % 3 == 1 ? wobble : 0)));
    values(i, 0) = f(times.back());
  }
  return {times, values};
}

TEST(QuinticSpline, a_parabola_is_its_own_spline) {
  const auto f = [](Real t) { return 3 - 2 * t + 5 * t * t; };
  const auto [times, values] = samples(9, 0.1, 0.3, f);
  const QuinticSpline spline = quintic_spline(times, values);
  for (const Real t : {-0.1, 0.0, 0.234, 0.5, 0.9}) EXPECT_NEAR(evaluate(spline, t)[0], f(t), 1e-11);
  EXPECT_NEAR(spline.slopes(4, 0), -2 + 10 * times[4], 1e-10);
  EXPECT_NEAR(spline.curvatures(4, 0), 10, 1e-9);
}

TEST(QuinticSpline, slopes_and_curvatures_of_a_sine_are_close_inside) {
  const auto [times, values] = samples(401, 0.005, 0.2, [](Real t) { return std::sin(6 * t); });
  const QuinticSpline spline = quintic_spline(times, values);
  EXPECT_NEAR(spline.slopes(200, 0), 6 * std::cos(6 * times[200]), 1e-8);
  EXPECT_NEAR(spline.curvatures(200, 0), -36 * std::sin(6 * times[200]), 1e-5);
  EXPECT_NEAR(evaluate(spline, 1.00123)[0], std::sin(6 * 1.00123), 1e-11);
}

TEST(QuinticSpline, five_rows_are_too_few) {
  const auto [times, values] = samples(5, 0.1, 0, [](Real) { return 1.0; });
  EXPECT_NE(message_of_input_error([&] { quintic_spline(times, values); }).find("less than 6 rows"), std::string::npos);
}

TEST(QuinticSpline, two_rows_that_almost_coincide_are_refused_by_name) {
  const Eigen::MatrixXd values = Eigen::VectorXd::LinSpaced(7, 0, 0.06);
  for (const Real second : {1e-300, 1e-9}) {
    const std::vector<Real> times = {0, second, 0.01, 0.02, 0.03, 0.04, 0.05};
    const std::string message = message_of_input_error([&] { quintic_spline(times, values); });
    EXPECT_NE(message.find("rows 1 and 2"), std::string::npos) << message;
  }
}

TEST(QuinticSpline, values_beyond_all_numbers_are_refused) {
  auto [times, values] = samples(9, 1e-3, 0, [](Real t) { return t; });
  values(4, 0) = 1e308;
  EXPECT_NE(message_of_input_error([&] { quintic_spline(times, values); }).find("not finite"), std::string::npos);
}

TEST(LowPass, uneven_rows_that_need_millions_of_even_ones_are_refused_by_their_times) {
  auto [times, values] = samples(400, 0.01, 0, [](Real t) { return t; });
  times[7] = times[6] + 2e-8;  // more than the millionth of the mean step that splines take
  const std::string message = message_of_input_error([&] { low_pass(times, values, 6); });
  EXPECT_NE(message.find("rows 7 and 8 of the motion, at 0.06 s and 0.06"), std::string::npos) << message;
}

TEST(LowPass, a_straight_line_goes_through_unchanged) {
  const auto [times, values] = samples(200, 0.01, 0, [](Real t) { return 1 + 4 * t; });
  EXPECT_LT((low_pass(times, values, 6) - values).cwiseAbs().maxCoeff(), 1e-3);
}

/// The largest value in the middle half of a filtered sine of 1.
static Real passed(Real frequency, Real cutoff, Real wobble = 0) {
  const auto [times, values] = samples(1000, 0.005, wobble, [&](Real t) { return std::sin(2 * pi * frequency * t); });
  return low_pass(times, values, cutoff).middleRows(250, 500).cwiseAbs().maxCoeff();
}

TEST(LowPass, at_the_cutoff_half_is_left_and_beyond_it_hardly_anything) {
  // A third-order Butterworth filter leaves 1 / sqrt(2) there, run twice 1 / 2.
  EXPECT_NEAR(passed(6, 6), 0.5, 1e-3);
  EXPECT_NEAR(passed(0.6, 6), 1, 1e-3);
  EXPECT_LT(passed(30, 6), 1e-3);
  EXPECT_NEAR(passed(6, 6, 0.2), 0.5, 1e-2);  // uneven times
}

TEST(LowPass, nothing_is_delayed) {
  const auto [times, values] = samples(1000, 0.005, 0, [](Real t) { return std::sin(2 * pi * 3 * t); });
  const Eigen::MatrixXd filtered = low_pass(times, values, 6);
  const Real gain = 1 / (1 + std::pow(0.5, 6));
  EXPECT_LT((filtered - gain * values).middleRows(250, 500).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(LowPass, a_cutoff_beyond_half_the_sampling_rate_is_refused) {
  const auto [times, values] = samples(10, 0.1, 0, [](Real) { return 1.0; });
  EXPECT_THROW(low_pass(times, values, 5), ConfigurationError);
}

}  // namespace gracilis::opensim
