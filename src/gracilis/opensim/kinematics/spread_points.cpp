#include <gracilis/opensim/kinematics/spread_points.hpp>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace gracilis::opensim {

Eigen::MatrixXd latin_hypercube(Index count, Index columns, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Eigen::MatrixXd points(count, columns);
  std::vector<Index> order(static_cast<std::size_t>(count));
  for (Index column = 0; column < columns; ++column) {
    std::iota(order.begin(), order.end(), 0);
    // std::shuffle differs between libraries.
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    for (Index row = 0; row < count; ++row)
      points(row, column) = (static_cast<Real>(order[static_cast<std::size_t>(row)]) + 0.5) / static_cast<Real>(count);
  }
  return points;
}

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
