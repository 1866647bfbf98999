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

namespace {

/// Per vertex: what the cheapest way to it costs, infinity where none leads, and the vertex before it on that way, -1
/// on sources.
struct Ways {
  Eigen::VectorXd costs;
  std::vector<Index> previous;
};

/// Of the vertices reached before `until` (-1: of all) the ways are final.
Ways cheapest_ways(const EdgeGraph& graph, const std::vector<Index>& sources, Index until) {
  const std::size_t count = graph.stars.offsets.size() - 1;
  Ways ways{Eigen::VectorXd::Constant(static_cast<Index>(count), std::numeric_limits<Real>::infinity()),
            std::vector<Index>(count, -1)};
  // Equal costs come in the order of the vertices.
  using Entry = std::pair<Real, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  for (const Index source : sources) ways.costs[source] = 0, front.emplace(0, source);
  while (!front.empty()) {
    const auto [reached, vertex] = front.top();
    front.pop();
    if (vertex == until) break;
    if (reached > ways.costs[vertex]) continue;
    const auto v = static_cast<std::size_t>(vertex);
    for (Index i = graph.stars.offsets[v]; i < graph.stars.offsets[v + 1]; ++i) {
      const Index neighbor = graph.stars.neighbors[static_cast<std::size_t>(i)];
      const Real through = reached + graph.costs[static_cast<std::size_t>(i)];
      if (!(through < ways.costs[neighbor])) continue;
      ways.costs[neighbor] = through;
      ways.previous[static_cast<std::size_t>(neighbor)] = vertex;
      front.emplace(through, neighbor);
    }
  }
  return ways;
}

}  // namespace

std::vector<Index> shortest_path(const EdgeGraph& graph, Index from, Index to) {
  const Ways ways = cheapest_ways(graph, {from}, to);
  if (ways.costs[to] == std::numeric_limits<Real>::infinity()) return {};
  std::vector<Index> path = {to};
  while (path.back() != from) path.push_back(ways.previous[static_cast<std::size_t>(path.back())]);
  std::reverse(path.begin(), path.end());
  return path;
}

Eigen::VectorXd edge_distances(const EdgeGraph& graph, const std::vector<Index>& sources) {
  return cheapest_ways(graph, sources, -1).costs;
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
