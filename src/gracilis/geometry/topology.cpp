#include <gracilis/geometry/topology.hpp>

#include <gracilis/geometry/half_edges.hpp>

namespace gracilis {

namespace {

VertexStars stars_of(const std::vector<MeshEdge>& edges, Index vertex_count) {
  VertexStars stars;
  stars.offsets.assign(static_cast<std::size_t>(vertex_count) + 1, 0);
  for (const MeshEdge& edge : edges) {
    ++stars.offsets[static_cast<std::size_t>(edge.a) + 1];
    ++stars.offsets[static_cast<std::size_t>(edge.b) + 1];
  }
  for (std::size_t v = 0; v + 1 < stars.offsets.size(); ++v) stars.offsets[v + 1] += stars.offsets[v];
  stars.neighbors.resize(static_cast<std::size_t>(stars.offsets.back()));
  std::vector<Index> next(stars.offsets.begin(), stars.offsets.end() - 1);
  // Smaller neighbors first, then larger: edges are ordered by (a, b), so each star comes out ascending.
  for (const MeshEdge& edge : edges)
    stars.neighbors[static_cast<std::size_t>(next[static_cast<std::size_t>(edge.b)]++)] = edge.a;
  for (const MeshEdge& edge : edges)
    stars.neighbors[static_cast<std::size_t>(next[static_cast<std::size_t>(edge.a)]++)] = edge.b;
  return stars;
}

}  // namespace

MeshTopology build_topology(const Eigen::Matrix3Xi& faces, Index vertex_count) {
  MeshTopology topology;
  for_each_edge(sorted_half_edges(faces), [&](std::span<const HalfEdge> sides) {
    MeshEdge edge = {sides[0].low, sides[0].high, -1, -1, -1, -1};
    for (const HalfEdge& side : sides) {
      if (side.forward && edge.left < 0) {
        edge.left = side.face, edge.left_apex = side.apex;
      } else if (edge.right < 0) {
        edge.right = side.face, edge.right_apex = side.apex;
      }
    }
    topology.edges.push_back(edge);
  });
  topology.stars = stars_of(topology.edges, vertex_count);
  return topology;
}

bool is_closed(const Eigen::Matrix3Xi& faces) {
  const std::vector<HalfEdge> half_edges = sorted_half_edges(faces);
  bool closed = static_cast<Eigen::Index>(half_edges.size()) == faces.size();  // no face names a vertex twice
  for_each_edge(half_edges, [&](std::span<const HalfEdge> sides) {
    closed = closed && sides.size() == 2 && sides[0].forward != sides[1].forward;
  });
  return closed;
}

std::vector<Index> breadth_first_order(const VertexStars& stars) {
  const auto count = stars.offsets.size() - 1;
  std::vector<Index> order;
  order.reserve(count);
  std::vector<char> seen(count, 0);
  for (std::size_t seed = 0; seed < count; ++seed) {
    if (seen[seed]) continue;
    seen[seed] = 1;
    order.push_back(static_cast<Index>(seed));
    for (std::size_t head = order.size() - 1; head < order.size(); ++head) {
      const auto v = static_cast<std::size_t>(order[head]);
      for (Index i = stars.offsets[v]; i < stars.offsets[v + 1]; ++i) {
        const Index neighbor = stars.neighbors[static_cast<std::size_t>(i)];
        if (seen[static_cast<std::size_t>(neighbor)]) continue;
        seen[static_cast<std::size_t>(neighbor)] = 1;
        order.push_back(neighbor);
      }
    }
  }
  return order;
}

}  // namespace gracilis
