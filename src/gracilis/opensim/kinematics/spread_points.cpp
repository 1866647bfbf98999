#include <gracilis/opensim/kinematics/spread_points.hpp>

#include <algorithm>
#include <numeric>
#include <vector>

namespace gracilis::opensim {

Eigen::MatrixXd nearest_next(const Eigen::MatrixXd& rows, const Eigen::RowVectorXd& begin) {
  std::vector<Eigen::Index> left(static_cast<std::size_t>(rows.rows()));
  std::iota(left.begin(), left.end(), 0);
  Eigen::MatrixXd ordered(rows.rows(), rows.cols());
  Eigen::RowVectorXd last = begin;
  for (Eigen::Index row = 0; row < rows.rows(); ++row) {
    const auto distance = [&](Eigen::Index i) { return (rows.row(i) - last).squaredNorm(); };
    const auto next = std::min_element(left.begin(), left.end(),
                                       [&](Eigen::Index a, Eigen::Index b) { return distance(a) < distance(b); });
    last = ordered.row(row) = rows.row(*next);
    left.erase(next);
  }
  return ordered;
}

}  // namespace gracilis::opensim
