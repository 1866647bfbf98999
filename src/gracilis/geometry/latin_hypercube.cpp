#include <gracilis/geometry/latin_hypercube.hpp>

#include <numeric>
#include <utility>

namespace gracilis {

std::vector<Index> shuffled_order(Index count, std::mt19937_64& random) {
  std::vector<Index> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

Eigen::MatrixXd latin_hypercube(Index count, Index columns, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Eigen::MatrixXd points(count, columns);
  for (Index column = 0; column < columns; ++column) {
    const std::vector<Index> order = shuffled_order(count, random);
    for (Index row = 0; row < count; ++row)
      points(row, column) = (static_cast<Real>(order[static_cast<std::size_t>(row)]) + 0.5) / static_cast<Real>(count);
  }
  return points;
}

}  // namespace gracilis
