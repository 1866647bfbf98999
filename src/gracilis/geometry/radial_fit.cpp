#include <gracilis/geometry/radial_fit.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/radial_sparse.hpp>

#include <Eigen/LU>
#include <Eigen/QR>

#include <cassert>
#include <cmath>
#include <cstdio>
#include <limits>

namespace gracilis {

namespace {

/// Beyond this condition number no digit of a solution in double precision is left.
constexpr Real worst_condition = 1 / std::numeric_limits<Real>::epsilon();

[[noreturn]] void throw_singular(Index count, Real condition) {
  char text[160];
  std::snprintf(text, sizeof text, "the system of %d radial basis functions is singular (condition number about %.1e)",
                count, condition);
  throw InputError({"", "", text,
                    "leave out centers that coincide, or choose another reach or kernel; 'power-minus-1' needs an "
                    "exponent that is no whole number"});
}

RadialBasis basis_of(const RadialFitSettings& settings, const Points& centers, const Eigen::VectorXd& reaches,
                     const Points& points) {
  const Eigen::AlignedBox3d box = bounding_box(points);
  const Real size = box.sizes().norm() / 2;
  RadialBasis basis;
  basis.kernel = settings.kernel;
  basis.dimensions = settings.dimensions;
  basis.centers = centers;
  basis.reaches = reaches;
  basis.origin = box.center();
  basis.size = size > 0 ? size : 1;
  return basis;
}

Index terms_of(const RadialFitSettings& settings) {
  return settings.polynomial == RadialPolynomial::none       ? 0
         : settings.polynomial == RadialPolynomial::constant ? 1
                                                             : 1 + settings.dimensions;
}

/// The polynomial's terms at each point: points × terms.
Eigen::MatrixXd terms_at(const RadialBasis& basis, const Points& points, Index terms) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Ones(points.cols(), terms);
  for (Index k = 1; k < terms; ++k)
    matrix.col(k) = (points.row(k - 1).array() - basis.origin[k - 1]).transpose() / basis.size;
  return matrix;
}

/// φ(|x_i - ξ_j|): points × centers.
void fill_kernels(const RadialBasis& basis, const Points& points, Eigen::Ref<Eigen::MatrixXd> matrix) {
  parallel_for(basis.count(), 8, [&](Index begin, Index end) {
    for (Index j = begin; j < end; ++j)
      for (Index i = 0; i < static_cast<Index>(points.cols()); ++i)
        matrix(i, j) = radial_value(basis.kernel, basis.reaches[j], (points.col(i) - basis.centers.col(j)).norm());
  });
}

Eigen::MatrixXd dense_system(const RadialBasis& basis, Index terms) {
  const Index n = basis.count();
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + terms, n + terms);
  fill_kernels(basis, basis.centers, system.topLeftCorner(n, n));
  system.topRightCorner(n, terms) = terms_at(basis, basis.centers, terms);
  system.bottomLeftCorner(terms, n) = system.topRightCorner(n, terms).transpose();
  return system;
}

Real condition_of(const Eigen::PartialPivLU<Eigen::MatrixXd>& factors) {
  // The estimate solves with the factors, which has no meaning where a pivot is 0.
  if (factors.matrixLU().diagonal().cwiseAbs().minCoeff() == 0) return std::numeric_limits<Real>::infinity();
  const Real reciprocal = factors.rcond();
  return reciprocal > 0 ? 1 / reciprocal : std::numeric_limits<Real>::infinity();
}

RadialFit interpolate_densely(RadialBasis basis, Index terms, const Eigen::VectorXd& values) {
  const Index n = basis.count();
  const Eigen::MatrixXd system = dense_system(basis, terms);
  const Eigen::PartialPivLU<Eigen::MatrixXd> factors(system);
  const Real condition = condition_of(factors);
  if (!(condition < worst_condition)) throw_singular(n, condition);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n + terms);
  right.head(n) = values;
  Eigen::VectorXd solution = factors.solve(right);
  // One refinement takes back what the factors' rounding left.
  solution += factors.solve(right - system * solution);
  basis.weights = solution.head(n);
  basis.polynomial = solution.tail(terms);
  return {std::move(basis), condition, 0};
}

/// A X = [values, P] by sparse A, then the small system (Pᵀ A⁻¹ P) a = Pᵀ A⁻¹ values for the polynomial.
RadialFit interpolate_sparsely(RadialBasis basis, Index terms, const Eigen::VectorXd& values) {
  const Eigen::MatrixXd p = terms_at(basis, basis.centers, terms);
  const SparseKernelSolver solver(basis.kernel, basis.centers, basis.reaches[0]);
  if (!(solver.condition() < worst_condition)) throw_singular(basis.count(), solver.condition());
  basis.weights = solver.solve(values);
  if (terms > 0) {
    Eigen::MatrixXd through(p.rows(), terms);
    for (Index k = 0; k < terms; ++k) through.col(k) = solver.solve(p.col(k));
    const Eigen::PartialPivLU<Eigen::MatrixXd> small(p.transpose() * through);
    if (!(condition_of(small) < worst_condition)) throw_singular(basis.count(), condition_of(small));
    basis.polynomial = small.solve(p.transpose() * basis.weights);
    // Solved anew for what the polynomial leaves, so that values it has exactly leave weights of 0.
    basis.weights = solver.solve(values - p * basis.polynomial);
    const Eigen::VectorXd rest = small.solve(p.transpose() * basis.weights);
    basis.polynomial += rest;
    basis.weights -= through * rest;
  }
  const Eigen::VectorXd left =
      values - solver.times(basis.weights) -
      (terms > 0 ? Eigen::VectorXd(p * basis.polynomial) : Eigen::VectorXd::Zero(values.size()));
  return {std::move(basis), solver.condition(), left.cwiseAbs().maxCoeff()};
}

}  // namespace

RadialFit interpolate(const RadialFitSettings& settings, const Points& points, Real reach,
                      const Eigen::VectorXd& values) {
  assert(points.cols() == values.size() && values.size() > 0);
  RadialBasis basis = basis_of(settings, points, Eigen::VectorXd::Constant(points.cols(), reach), points);
  const Index terms = terms_of(settings);
  if (is_compact(settings.kernel)) return interpolate_sparsely(std::move(basis), terms, values);
  RadialFit fit = interpolate_densely(std::move(basis), terms, values);
  fit.largest_residual = errors_at(fit.basis, points, values).cwiseAbs().maxCoeff();
  return fit;
}

RadialFit fit_least_squares(const RadialFitSettings& settings, const Points& centers, const Eigen::VectorXd& reaches,
                            const Points& points, const Eigen::VectorXd& values, const Eigen::VectorXd& point_weights) {
  RadialBasis basis = basis_of(settings, centers, reaches, points);
  const Index n = basis.count(), terms = terms_of(settings);
  if (points.cols() < n + terms)
    throw InputError({"", "",
                      "there are " + std::to_string(points.cols()) + " values for " + std::to_string(n + terms) +
                          " unknowns of radial basis functions",
                      "take fewer centers"});
  Eigen::MatrixXd matrix(points.cols(), n + terms);
  fill_kernels(basis, points, matrix.leftCols(n));
  matrix.rightCols(terms) = terms_at(basis, points, terms);
  Eigen::VectorXd right = values;
  if (point_weights.size() > 0) {
    matrix = point_weights.asDiagonal() * matrix;
    right = right.cwiseProduct(point_weights);
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> factors(matrix);
  const Eigen::MatrixXd triangle = factors.matrixQR().topRows(n + terms).triangularView<Eigen::Upper>();
  const Eigen::PartialPivLU<Eigen::MatrixXd> of_triangle(triangle);
  const Real condition = condition_of(of_triangle);
  if (!(condition < worst_condition)) throw_singular(n, condition);
  const Eigen::VectorXd solution = factors.solve(right);
  basis.weights = solution.head(n);
  basis.polynomial = solution.tail(terms);
  RadialFit fit{std::move(basis), condition, 0};
  fit.largest_residual = errors_at(fit.basis, points, values).cwiseAbs().maxCoeff();
  return fit;
}

Real interpolation_condition(const RadialFitSettings& settings, const Points& points, Real reach) {
  const RadialBasis basis = basis_of(settings, points, Eigen::VectorXd::Constant(points.cols(), reach), points);
  return condition_of(Eigen::PartialPivLU<Eigen::MatrixXd>(dense_system(basis, terms_of(settings))));
}

}  // namespace gracilis
