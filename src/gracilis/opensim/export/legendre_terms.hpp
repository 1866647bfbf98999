#pragma once

#include <gracilis/opensim/export/path_samples.hpp>

#include <vector>

namespace gracilis::opensim {

/// Products of Legendre's polynomials of coordinates, each over a range of its own, by ascending total order, so that
/// those of a lower order come first.
class LegendreTerms {
 public:
  /// The ranges are those of the columns, of samples and what they are drawn to together.
  LegendreTerms(const Eigen::VectorXd& least, const Eigen::VectorXd& most, int order);

  /// How many terms there are up to an order.
  Eigen::Index count(int order) const;

  /// The terms' values, and with `by` from 0 on their derivatives by that coordinate: a row per pose.
  Eigen::MatrixXd rows(const Eigen::MatrixXd& coordinates, int by = -1) const;

  /// The sum of the first `order`'s terms with these coefficients as a polynomial in powers of the coordinates.
  Function in_powers(const Eigen::VectorXd& coefficients, int order) const;

 private:
  Eigen::VectorXd center_, half_;
  std::vector<std::vector<int>> degrees_;
};

}  // namespace gracilis::opensim
