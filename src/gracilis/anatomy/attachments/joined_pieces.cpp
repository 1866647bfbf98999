#include <gracilis/anatomy/attachments/joined_pieces.hpp>

#include <gracilis/core/sort_unique.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/geometry/nearest_points.hpp>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

namespace gracilis {
namespace {

using Bridge = std::pair<Index, Index>;

/// From each vertex of the piece to the nearest of the others, where that is about as near as any.
std::vector<Bridge> bridges_to(const Points& x, const std::vector<Index>& piece, const std::vector<Index>& others,
                               Real slack) {
  const NearestPoints nearest(x(Eigen::all, others));
  std::vector<Bridge> all, near;
  Real least = std::numeric_limits<Real>::infinity();
  for (const Index v : piece) {
    const Index other = others[static_cast<std::size_t>(nearest.nearest(x.col(v)))];
    least = std::min(least, (x.col(v) - x.col(other)).norm());
    all.emplace_back(v, other);
  }
  for (const Bridge& bridge : all)
    if ((x.col(bridge.first) - x.col(bridge.second)).norm() <= least + slack) near.push_back(bridge);
  return near;
}

VertexStars stars_with(const VertexStars& stars, const std::vector<Bridge>& bridges) {
  std::vector<std::set<Index>> added(stars.offsets.size() - 1);
  for (const auto& [a, b] : bridges) {
    added[static_cast<std::size_t>(a)].insert(b);
    added[static_cast<std::size_t>(b)].insert(a);
  }
  VertexStars result{{0}, {}};
  for (std::size_t v = 0; v < added.size(); ++v) {
    std::set<Index>& around = added[v];
    around.insert(stars.neighbors.begin() + stars.offsets[v], stars.neighbors.begin() + stars.offsets[v + 1]);
    result.neighbors.insert(result.neighbors.end(), around.begin(), around.end());
    result.offsets.push_back(static_cast<Index>(result.neighbors.size()));
  }
  return result;
}

}  // namespace

MeshTopology joined_pieces(const TriangleMesh& surface, const MeshTopology& topology,
                           const std::vector<Index>& fixed_body) {
  const std::vector<Index> component = component_of_vertices(surface);
  const Index count = component_count(component);
  if (count < 2) return topology;
  std::vector<std::vector<Index>> vertices(static_cast<std::size_t>(count));
  std::vector<std::set<Index>> bodies(vertices.size());
  std::set<Index> all_bodies;
  for (std::size_t v = 0; v < component.size(); ++v) {
    if (component[v] < 0) continue;
    const auto piece = static_cast<std::size_t>(component[v]);
    vertices[piece].push_back(static_cast<Index>(v));
    if (fixed_body[v] < 0) continue;
    bodies[piece].insert(fixed_body[v]);
    all_bodies.insert(fixed_body[v]);
  }
  if (all_bodies.empty()) return topology;
  const Real slack = mean_edge_length(topology.edges, surface.vertices);
  std::vector<Bridge> bridges;
  for (std::size_t piece = 0; piece < vertices.size(); ++piece) {
    if (bodies[piece] == all_bodies) continue;
    // What holds to nothing itself holds nobody.
    std::vector<Index> others;
    for (std::size_t other = 0; other < vertices.size(); ++other)
      if (other != piece && !bodies[other].empty())
        others.insert(others.end(), vertices[other].begin(), vertices[other].end());
    if (others.empty()) continue;
    for (const auto& [a, b] : bridges_to(surface.vertices, vertices[piece], others, slack))
      bridges.emplace_back(std::minmax(a, b));
  }
  sort_unique(bridges);
  MeshTopology joined{topology.edges, stars_with(topology.stars, bridges)};
  for (const auto& [a, b] : bridges) {
    MeshEdge edge;
    edge.a = a, edge.b = b;
    joined.edges.push_back(edge);
  }
  std::sort(joined.edges.begin(), joined.edges.end(),
            [](const MeshEdge& l, const MeshEdge& r) { return std::pair(l.a, l.b) < std::pair(r.a, r.b); });
  return joined;
}

}  // namespace gracilis
