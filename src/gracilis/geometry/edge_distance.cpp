#include <gracilis/geometry/edge_distance.hpp>

#include <limits>
#include <queue>

namespace gracilis {

Eigen::VectorXd edge_distances(const Points& vertices, const MeshTopology& topology,
                               const std::vector<Index>& sources) {
  using Reached = std::pair<Real, Index>;  // distance, vertex
  Eigen::VectorXd distances = Eigen::VectorXd::Constant(vertices.cols(), std::numeric_limits<Real>::infinity());
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
  for (Index v : sources) distances[v] = 0, front.emplace(0, v);
  const VertexStars& stars = topology.stars;
  while (!front.empty()) {
    const auto [distance, v] = front.top();
    front.pop();
    if (distance > distances[v]) continue;
    const auto at = static_cast<std::size_t>(v);
    for (Index i = stars.offsets[at]; i < stars.offsets[at + 1]; ++i) {
      const Index neighbor = stars.neighbors[static_cast<std::size_t>(i)];
      const Real through = distance + (vertices.col(v) - vertices.col(neighbor)).norm();
      if (through < distances[neighbor]) distances[neighbor] = through, front.emplace(through, neighbor);
    }
  }
  return distances;
}

}  // namespace gracilis
