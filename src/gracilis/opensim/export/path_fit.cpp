#include <gracilis/opensim/export/path_fit.hpp>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

/// The terms of a polynomial, a row per pose.
static Eigen::MatrixXd terms_of(const Eigen::MatrixXd& coordinates, int order) {
  const auto powers = monomials(static_cast<int>(coordinates.cols()), order);
  Eigen::MatrixXd terms = Eigen::MatrixXd::Ones(coordinates.rows(), static_cast<Eigen::Index>(powers.size()));
  for (std::size_t term = 0; term < powers.size(); ++term)
    for (std::size_t i = 0; i < powers[term].size(); ++i)
      for (int power = 0; power < powers[term][i]; ++power)
        terms.col(static_cast<Eigen::Index>(term)).array() *= coordinates.col(static_cast<Eigen::Index>(i)).array();
  return terms;
}

/// Least squares; columns are brought to the same size first, and what cannot be told apart stays small.
static Eigen::VectorXd least_squares(const Eigen::MatrixXd& terms, const Eigen::VectorXd& lengths) {
  const Eigen::VectorXd sizes = terms.colwise().norm().cwiseMax(1e-300).transpose();
  const Eigen::MatrixXd scaled = terms * sizes.cwiseInverse().asDiagonal();
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(1e-11);
  solver.compute(scaled);
  return solver.solve(lengths).cwiseQuotient(sizes);
}

/// Root mean square of the errors at rows that the fit did not see.
static Real left_out_error(const Eigen::MatrixXd& terms, const Eigen::VectorXd& lengths) {
  const int parts = 5;
  Real sum = 0;
  for (int part = 0; part < parts; ++part) {
    std::vector<Eigen::Index> kept, left;
    for (Eigen::Index row = 0; row < terms.rows(); ++row) (row % parts == part ? left : kept).push_back(row);
    if (left.empty() || kept.empty()) continue;
    const Eigen::VectorXd fit = least_squares(terms(kept, Eigen::all), lengths(kept));
    sum += (terms(left, Eigen::all) * fit - lengths(left)).squaredNorm();
  }
  return std::sqrt(sum / static_cast<Real>(terms.rows()));
}

PathFit fit_path(const Eigen::MatrixXd& coordinates, const Eigen::VectorXd& lengths, int largest_order) {
  const Real rounding = 1e-9;  // m
  PathFit best;
  for (int order = 0; order <= largest_order; ++order) {
    const Eigen::MatrixXd terms = terms_of(coordinates, order);
    if (order > 0 && 2 * terms.cols() > terms.rows()) break;
    const Real error = left_out_error(terms, lengths);
    if (order > 0 && error > 0.99 * best.left_out - rounding) continue;
    const Eigen::VectorXd fit = least_squares(terms, lengths);
    const Eigen::VectorXd off = terms * fit - lengths;
    best.function.kind = Function::Kind::multivariate;
    best.function.dimension = static_cast<int>(coordinates.cols());
    best.function.order = order;
    best.function.coefficients.assign(fit.data(), fit.data() + fit.size());
    best.root_mean_square = std::sqrt(off.squaredNorm() / static_cast<Real>(off.size()));
    best.largest = off.lpNorm<Eigen::Infinity>();
    best.left_out = error;
  }
  return best;
}

}  // namespace gracilis::opensim
