#include <gracilis/opensim/functions/smoothing_spline.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gracilis::opensim {

/// A spline as a polynomial below degree m and multiples of |x - x_i|^(2m-1), orthogonal to such polynomials, over the
/// points brought into [-1, 1].
struct SplineTerms {
  Eigen::VectorXd places;  ///< of the points, in [-1, 1]
  int m = 2;
  Eigen::VectorXd polynomial;  ///< from the lowest power up
  Eigen::VectorXd kernels;

  /// The k-th derivative over k! at a place; the last one as it is to the right.
  Real taylor(Real x, int k) const {
    const auto choose = [&](int n) {
      Real factor = 1;
      for (int i = 0; i < k; ++i) factor *= static_cast<Real>(n - i) / (i + 1);
      return factor;
    };
    Real sum = 0;
    for (int j = k; j < m; ++j) sum += polynomial[j] * choose(j) * std::pow(x, j - k);
    const int degree = 2 * m - 1;
    for (Eigen::Index i = 0; i < places.size(); ++i) {
      const Real d = x - places[i];
      sum += kernels[i] * choose(degree) * std::pow(d, degree - k) * (d < 0 ? -1 : 1);
    }
    return sum;
  }
};

/// Σ w (y - f)² + p ∫ (f⁽ᵐ⁾)² is least where K d + P c + p s W⁻¹ d = y and Pᵀ d = 0. Of these, with d = Z u, Z a basis
/// of what is orthogonal to P, remains (Zᵀ K Z + p Zᵀ W⁻¹ Z) u = Zᵀ y; the sign of K is chosen so that it is definite.
struct SplineSystem {
  Eigen::MatrixXd kernel, polynomials, basis;
  Eigen::VectorXd inverse_weights, values;
  Eigen::MatrixXd modes;      ///< V with Vᵀ Zᵀ W⁻¹ Z V = 1 and Vᵀ Zᵀ K Z V diagonal
  Eigen::VectorXd stiffness;  ///< that diagonal
  Eigen::VectorXd loads;      ///< Vᵀ Zᵀ y

  /// The multiples of the kernels.
  Eigen::VectorXd kernels(Real p) const { return basis * (modes * (loads.array() / (stiffness.array() + p)).matrix()); }
  /// Weighted sum of squared residuals, which are p W⁻¹ d.
  Real misfit(Real p) const { return (p * loads.array() / (stiffness.array() + p)).square().sum(); }
  /// Trace of what takes values to residuals.
  Real freedom(Real p) const { return (p / (stiffness.array() + p)).sum(); }
};

static SplineSystem system_of(const Eigen::VectorXd& x, const Eigen::VectorXd& y, int m,
                              const std::vector<Real>& weights) {
  const Eigen::Index n = x.size();
  SplineSystem system;
  system.values = y;
  system.kernel.resize(n, n);
  const Real sign = m % 2 == 0 ? 1 : -1;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) system.kernel(i, j) = sign * std::pow(std::abs(x[i] - x[j]), 2 * m - 1);
  system.polynomials.resize(n, m);
  for (int j = 0; j < m; ++j) system.polynomials.col(j) = x.array().pow(j);
  system.inverse_weights.setOnes(n);
  for (std::size_t i = 0; i < weights.size(); ++i) system.inverse_weights[static_cast<Eigen::Index>(i)] /= weights[i];
  const Eigen::MatrixXd all = system.polynomials.householderQr().householderQ();
  system.basis = all.rightCols(n - m);
  const Eigen::MatrixXd& z = system.basis;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      z.transpose() * system.kernel * z, z.transpose() * system.inverse_weights.asDiagonal() * z);
  system.modes = solver.eigenvectors();
  system.stiffness = solver.eigenvalues().cwiseMax(0);
  system.loads = system.modes.transpose() * (z.transpose() * y);
  return system;
}

/// The p on a fine scale of powers of ten for which the criterion is least.
static Real best_smoothing(const SplineSystem& system, Real variance) {
  const auto n = static_cast<Real>(system.values.size());
  const Real largest = std::max(system.stiffness.maxCoeff(), 1e-300);
  Real best = 0, least = std::numeric_limits<Real>::infinity();
  for (Real power = -14; power <= 6; power += 0.02) {
    const Real p = largest * std::pow(10.0, power), misfit = system.misfit(p), freedom = system.freedom(p);
    const Real criterion = variance < 0 ? n * misfit / (freedom * freedom) : misfit - 2 * variance * freedom;
    if (!(criterion < least)) continue;
    least = criterion;
    best = p;
  }
  return best;
}

Function smoothing_spline(const std::vector<Real>& x, const std::vector<Real>& y,
                          const SmoothingSplineSettings& settings) {
  const auto n = static_cast<Eigen::Index>(x.size());
  const int m = settings.half_order;
  assert(n >= 2 * m && n <= 1000 && m >= 1 && m <= 4 && x.size() == y.size());
  const Real middle = (x.front() + x.back()) / 2, half = (x.back() - x.front()) / 2;
  Eigen::VectorXd values = Eigen::VectorXd::Map(y.data(), n);
  SplineTerms terms{(Eigen::VectorXd::Map(x.data(), n).array() - middle) / half, m, {}, {}};
  const SplineSystem system = system_of(terms.places, values, m, settings.weights);
  const Real p = settings.error_variance == 0 ? 0 : best_smoothing(system, settings.error_variance);
  if (p == 0) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n + m, n + m);
    matrix << system.kernel, system.polynomials, system.polynomials.transpose(), Eigen::MatrixXd::Zero(m, m);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n + m);
    right.head(n) = values;
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(matrix);
    Eigen::VectorXd solution = lu.solve(right);
    solution += lu.solve(right - matrix * solution);  // once more, for what rounding left
    terms.kernels = solution.head(n);
    terms.polynomial = solution.tail(m);
  } else {
    terms.kernels = system.kernels(p);
    const Eigen::VectorXd rest =
        values - system.kernel * terms.kernels - p * system.inverse_weights.cwiseProduct(terms.kernels);
    terms.polynomial = system.polynomials.householderQr().solve(rest);
  }
  if (m % 2 != 0) terms.kernels = -terms.kernels;  // the system's kernel has its sign turned

  Function function;
  function.kind = Function::Kind::spline;
  function.knots = x;
  function.pieces.resize(n, 2 * m);
  for (Eigen::Index i = 0; i < n; ++i)
    for (int k = 0; k < 2 * m; ++k) function.pieces(i, k) = terms.taylor(terms.places[i], k) / std::pow(half, k);
  return function;
}

}  // namespace gracilis::opensim
