#include <gracilis/simulate/moment_arms.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

Eigen::MatrixXd moment_arms(const Eigen::VectorXd& coordinate, const Eigen::MatrixXd& lengths) {
  const auto n = static_cast<Index>(coordinate.size());
  Eigen::MatrixXd arms = Eigen::MatrixXd::Zero(n, lengths.cols());
  if (n == 2) {
    arms.rowwise() = (lengths.row(0) - lengths.row(1)) / (coordinate[1] - coordinate[0]);
  }
  for (Index i = 0; n > 2 && i < n; ++i) {
    // Derivative at q_i of the parabola through rows k, k + 1, k + 2.
    const Index k = std::clamp(i - 1, 0, n - 3);
    const Real a = coordinate[k], b = coordinate[k + 1], c = coordinate[k + 2], q = coordinate[i];
    arms.row(i) = -(lengths.row(k) * ((2 * q - b - c) / ((a - b) * (a - c))) +
                    lengths.row(k + 1) * ((2 * q - a - c) / ((b - a) * (b - c))) +
                    lengths.row(k + 2) * ((2 * q - a - b) / ((c - a) * (c - b))));
  }
  return arms;
}

Real largest_step_per_degree(const Eigen::VectorXd& coordinate, const Eigen::VectorXd& arms) {
  Real largest = 0;
  for (Index i = 1; i < arms.size(); ++i) {
    largest = std::max(largest, std::abs(arms[i] - arms[i - 1]) / degrees(std::abs(coordinate[i] - coordinate[i - 1])));
  }
  return largest;
}

}  // namespace gracilis
