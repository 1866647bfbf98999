#include <gracilis/opensim/kinematics/low_pass.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/whole_number.hpp>
#include <gracilis/opensim/kinematics/quintic_spline.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

/// 1 / ((s + 1) (s² + s + 1)) by the bilinear transform, along the rows in place; it starts at rest at the first row.
static void butterworth(Eigen::MatrixXd& rows, Real warped) {
  const Real k = warped, norm = 1 + k + k * k;
  const Real single = k / (1 + k), single_back = (k - 1) / (k + 1);
  const Real pair = k * k / norm, pair_back1 = 2 * (k * k - 1) / norm, pair_back2 = (1 - k + k * k) / norm;
  Eigen::RowVectorXd x1 = rows.row(0), x2 = x1, y1 = x1, y2 = x1, before = x1;  // x: between both stages
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const Eigen::RowVectorXd now = rows.row(i), x = single * (now + before) - single_back * x1;
    const Eigen::RowVectorXd y = pair * (x + 2 * x1 + x2) - pair_back1 * y1 - pair_back2 * y2;
    before = now;
    x2 = x1;
    x1 = x;
    y2 = y1;
    y1 = y;
    rows.row(i) = y;
  }
}

static Eigen::MatrixXd filter_even(const Eigen::MatrixXd& values, Real step, Real cutoff) {
  const Eigen::Index n = values.rows(), pad = n / 2;
  Eigen::MatrixXd padded(n + 2 * pad, values.cols());
  padded.middleRows(pad, n) = values;
  for (Eigen::Index i = 1; i <= pad; ++i) {
    padded.row(pad - i) = 2 * values.row(0) - values.row(i);
    padded.row(pad + n - 1 + i) = 2 * values.row(n - 1) - values.row(n - 1 - i);
  }
  const Real warped = std::tan(pi * cutoff * step);
  for (int way = 0; way < 2; ++way) {
    butterworth(padded, warped);
    padded = padded.colwise().reverse().eval();
  }
  return padded.middleRows(pad, n);
}

/// Rows that uneven times are evened out to.
static constexpr Eigen::Index most_even_rows = 1'000'000;

/// How many rows lie so close that the shortest step, the one that begins at row `shortest`, is kept.
static Eigen::Index even_count(const std::vector<Real>& times, std::size_t shortest) {
  const Real span = times.back() - times.front(), least = times[shortest + 1] - times[shortest];
  const auto steps = whole_number<Eigen::Index>(std::ceil(span / least), 1, most_even_rows - 1);
  if (!steps)
    throw InputError({"", "",
                      fmt::format("rows {} and {} of the motion, at {} s and {} s, lie so close that more than {} even "
                                  "rows were needed to filter it",
                                  shortest + 1, shortest + 2, times[shortest], times[shortest + 1], most_even_rows),
                      "leave out rows that almost coincide"});
  return *steps + 1;
}

Eigen::MatrixXd low_pass(const std::vector<Real>& times, const Eigen::MatrixXd& values, Real cutoff) {
  Real least = times.back() - times.front(), most = 0;
  std::size_t shortest = 0;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const Real step = times[i + 1] - times[i];
    if (step < least) shortest = i;
    least = std::min(least, step);
    most = std::max(most, step);
  }
  if (!(cutoff > 0 && cutoff < 0.5 / most))
    throw ConfigurationError({"", "", fmt::format("the cutoff frequency of {} Hz cannot be kept", cutoff),
                              fmt::format("choose one between 0 and {} Hz", 0.5 / most)});
  if (most - least < 1e-3 * least) return filter_even(values, (least + most) / 2, cutoff);
  const Eigen::Index count = even_count(times, shortest);
  const QuinticSpline spline = quintic_spline(times, values);
  const Real step = (times.back() - times.front()) / static_cast<Real>(count - 1);
  std::vector<Real> even;
  Eigen::MatrixXd sampled(count, values.cols());
  for (Eigen::Index i = 0; i < count; ++i) {
    even.push_back(times.front() + step * static_cast<Real>(i));
    sampled.row(i) = evaluate(spline, even.back());
  }
  const QuinticSpline filtered = quintic_spline(even, filter_even(sampled, step, cutoff));
  Eigen::MatrixXd result(values.rows(), values.cols());
  for (std::size_t i = 0; i < times.size(); ++i)
    result.row(static_cast<Eigen::Index>(i)) = evaluate(filtered, times[i]);
  return result;
}

}  // namespace gracilis::opensim
