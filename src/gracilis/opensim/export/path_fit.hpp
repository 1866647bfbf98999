#pragma once

#include <gracilis/opensim/functions/function.hpp>

namespace gracilis::opensim {

/// A polynomial of coordinates fitted to a muscle's lengths.
struct PathFit {
  Function function;          ///< multivariate polynomial, rad and m to m
  Real root_mean_square = 0;  ///< m, of the lengths it was fitted to
  Real largest = 0;           ///< m
  Real left_out = 0;          ///< m, root mean square of lengths left out of the fit in cross-validation
};

/// Fits polynomials of order 0, 1 ... up to `largest_order` to `lengths` (m, a row per pose of `coordinates`, rad or m)
/// by least squares, and keeps the order that predicts left-out rows best: every fifth row is left out in turn. Orders
/// with more terms than half of the rows are not tried; a higher order must be better by 1 %. At least two rows.
PathFit fit_path(const Eigen::MatrixXd& coordinates, const Eigen::VectorXd& lengths, int largest_order = 9);

}  // namespace gracilis::opensim
