#include <gracilis/opensim/kinematics/quintic_spline.hpp>

#include <gracilis/core/errors.hpp>

#include <fmt/format.h>
#include <Eigen/SparseLU>

#include <algorithm>
#include <string_view>

namespace gracilis::opensim {

/// On a piece of width h, with u from 0 to 1: p0 + m0 u + c0/2 u² + A u³ + B u⁴ + C u⁵, where m = h p' and c = h² p''.
/// A, B and C as sums over p1 - p0, m0, m1, c0, c1.
using Row5 = Eigen::Matrix<Real, 1, 5>;
static const Row5 cubic = (Row5() << 10, -6, -4, -1.5, 0.5).finished();
static const Row5 quartic = (Row5() << -15, 8, 7, 1.5, -1).finished();
static const Row5 quintic = (Row5() << 6, -3, -3, -0.5, 0.5).finished();

/// Of the mean step: the fourth power of the inverse of a shorter one leaves the equations of the others no digits.
static constexpr Real shortest_step = 1e-6;

/// The row after which the shortest step begins.
static std::size_t row_before_shortest_step(const std::vector<Real>& times) {
  std::size_t found = 0;
  for (std::size_t i = 0; i + 1 < times.size(); ++i)
    if (!(times[i + 1] - times[i] >= times[found + 1] - times[found])) found = i;
  return found;
}

static InputError no_spline(const std::vector<Real>& times, std::string_view why) {
  const std::size_t row = row_before_shortest_step(times);
  return InputError(
      {"", "",
       fmt::format("no smooth course goes through the motion's {} rows from {} s to {} s, whose closest "
                   "are rows {} and {}, at {} s and {} s: {}",
                   times.size(), times.front(), times.back(), row + 1, row + 2, times[row], times[row + 1], why),
       "leave out rows that almost coincide, and values that no motion has"});
}

QuinticSpline quintic_spline(const std::vector<Real>& times, const Eigen::MatrixXd& values) {
  const auto n = static_cast<Eigen::Index>(times.size());
  if (n < 6)
    throw InputError({"", "", "a motion of less than 6 rows has no speeds and accelerations", "give a longer one"});
  const Real unit = (times.back() - times.front()) / static_cast<Real>(n - 1);
  const std::size_t shortest = row_before_shortest_step(times);
  if (!((times[shortest + 1] - times[shortest]) / unit >= shortest_step))
    throw no_spline(times, "their distance is less than a millionth of the mean step");
  std::vector<Eigen::Triplet<Real>> entries;
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(2 * n, values.cols());
  // Unknowns 2i and 2i + 1: slope and curvature at time i, in units of the mean step. Equations 2i and 2i + 1: the
  // third and the fourth derivative are the same on both sides of time i, and zero outside.
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    const Real h = (times[static_cast<std::size_t>(i + 1)] - times[static_cast<std::size_t>(i)]) / unit;
    const auto add = [&](Eigen::Index equation, Row5 of, Real factor) {
      of *= factor;
      right.row(equation) -= of[0] * (values.row(i + 1) - values.row(i));
      const Real scaled[4] = {of[1] * h, of[3] * h * h, of[2] * h, of[4] * h * h};  // slope, curvature; here, next
      for (Eigen::Index j = 0; j < 4; ++j) entries.emplace_back(equation, 2 * i + j, scaled[j]);
    };
    const Real third = 1 / (h * h * h), fourth = third / h;
    add(2 * i, 6 * cubic, third);
    add(2 * i + 1, 24 * quartic, fourth);
    add(2 * i + 2, 6 * cubic + 24 * quartic + 60 * quintic, -third);
    add(2 * i + 3, 24 * quartic + 120 * quintic, -fourth);
  }
  Eigen::SparseMatrix<Real> matrix(2 * n, 2 * n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<Real>> solver(matrix);
  if (solver.info() != Eigen::Success) throw no_spline(times, "its equations have no solution");
  const Eigen::MatrixXd unknowns = solver.solve(right);
  QuinticSpline spline{times, values, Eigen::MatrixXd(n, values.cols()), Eigen::MatrixXd(n, values.cols())};
  for (Eigen::Index i = 0; i < n; ++i) {
    spline.slopes.row(i) = unknowns.row(2 * i) / unit;
    spline.curvatures.row(i) = unknowns.row(2 * i + 1) / (unit * unit);
  }
  if (!spline.slopes.allFinite() || !spline.curvatures.allFinite())
    throw no_spline(times, "its speeds or accelerations are not finite");
  return spline;
}

Eigen::VectorXd evaluate(const QuinticSpline& spline, Real time) {
  const auto after = std::upper_bound(spline.times.begin() + 1, spline.times.end() - 1, time);
  const Eigen::Index i = after - spline.times.begin() - 1;
  const Real begin = spline.times[static_cast<std::size_t>(i)], h = *after - begin, u = (time - begin) / h;
  const Eigen::RowVectorXd m0 = h * spline.slopes.row(i), m1 = h * spline.slopes.row(i + 1);
  const Eigen::RowVectorXd c0 = h * h * spline.curvatures.row(i), c1 = h * h * spline.curvatures.row(i + 1);
  const Eigen::RowVectorXd rise = spline.values.row(i + 1) - spline.values.row(i);
  const auto sum = [&](const Row5& of) -> Eigen::RowVectorXd {
    return of[0] * rise + of[1] * m0 + of[2] * m1 + of[3] * c0 + of[4] * c1;
  };
  return spline.values.row(i) + u * (m0 + u * (c0 / 2 + u * (sum(cubic) + u * (sum(quartic) + u * sum(quintic)))));
}

}  // namespace gracilis::opensim
