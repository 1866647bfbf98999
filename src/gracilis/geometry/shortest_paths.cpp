#include <gracilis/geometry/shortest_paths.hpp>

#include <algorithm>
#include <limits>
#include <queue>

namespace gracilis {

EdgeGraph length_graph(const Points& vertices, const MeshTopology& topology) {
  EdgeGraph graph{topology.stars, {}};
  for (std::size_t v = 0; v + 1 < graph.stars.offsets.size(); ++v)
    for (Index i = graph.stars.offsets[v]; i < graph.stars.offsets[v + 1]; ++i)
      graph.costs.push_back(
          (vertices.col(graph.stars.neighbors[static_cast<std::size_t>(i)]) - vertices.col(static_cast<Index>(v)))
              .norm());
  return graph;
}

std::vector<Index> shortest_path(const EdgeGraph& graph, Index from, Index to) {
  const std::size_t count = graph.stars.offsets.size() - 1;
  std::vector<Real> cost(count, std::numeric_limits<Real>::infinity());
  std::vector<Index> previous(count, -1);
  // Equal costs come in the order of the vertices.
  using Entry = std::pair<Real, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  cost[static_cast<std::size_t>(from)] = 0;
  front.emplace(0, from);
  while (!front.empty()) {
    const auto [reached, vertex] = front.top();
    front.pop();
    if (vertex == to) break;
    const auto v = static_cast<std::size_t>(vertex);
    if (reached > cost[v]) continue;
    for (Index i = graph.stars.offsets[v]; i < graph.stars.offsets[v + 1]; ++i) {
      const Index neighbor = graph.stars.neighbors[static_cast<std::size_t>(i)];
      const auto n = static_cast<std::size_t>(neighbor);
      const Real through = reached + graph.costs[static_cast<std::size_t>(i)];
      if (!(through < cost[n])) continue;
      cost[n] = through;
      previous[n] = vertex;
      front.emplace(through, neighbor);
    }
  }
  if (cost[static_cast<std::size_t>(to)] == std::numeric_limits<Real>::infinity()) return {};
  std::vector<Index> path = {to};
  while (path.back() != from) path.push_back(previous[static_cast<std::size_t>(path.back())]);
  std::reverse(path.begin(), path.end());
  return path;
}

Real path_cost(const EdgeGraph& graph, const std::vector<Index>& path) {
  Real sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const auto v = static_cast<std::size_t>(path[i - 1]);
    for (Index k = graph.stars.offsets[v]; k < graph.stars.offsets[v + 1]; ++k)
      if (graph.stars.neighbors[static_cast<std::size_t>(k)] == path[i])
        sum += graph.costs[static_cast<std::size_t>(k)];
  }
  return sum;
}

}  // namespace gracilis
