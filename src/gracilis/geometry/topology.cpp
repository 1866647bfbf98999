#include <gracilis/geometry/topology.hpp>

#include <algorithm>
#include <tuple>

namespace gracilis {

namespace {

struct HalfEdge {
  Index a, b;  ///< a < b
  bool forward;
  Index face, apex;
};

std::vector<HalfEdge> sorted_half_edges(const Eigen::Matrix3Xi& faces) {
  std::vector<HalfEdge> half_edges;
  half_edges.reserve(static_cast<std::size_t>(faces.size()));
  for (Index face = 0; face < faces.cols(); ++face)
    for (int k = 0; k < 3; ++k) {
      const Index from = faces(k, face), to = faces((k + 1) % 3, face), apex = faces((k + 2) % 3, face);
      half_edges.push_back({std::min(from, to), std::max(from, to), from < to, face, apex});
    }
  std::sort(half_edges.begin(), half_edges.end(), [](const HalfEdge& l, const HalfEdge& r) {
    return std::tie(l.a, l.b, l.face) < std::tie(r.a, r.b, r.face);
  });
  return half_edges;
}

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
  for (const HalfEdge& half_edge : sorted_half_edges(faces)) {
    auto& edges = topology.edges;
    if (edges.empty() || edges.back().a != half_edge.a || edges.back().b != half_edge.b) {
      edges.push_back({half_edge.a, half_edge.b, -1, -1, -1, -1});
    }
    MeshEdge& edge = edges.back();
    if (half_edge.forward && edge.left < 0) {
      edge.left = half_edge.face, edge.left_apex = half_edge.apex;
    } else if (edge.right < 0) {
      edge.right = half_edge.face, edge.right_apex = half_edge.apex;
    }
  }
  topology.stars = stars_of(topology.edges, vertex_count);
  return topology;
}

bool is_closed(const Eigen::Matrix3Xi& faces) {
  const std::vector<HalfEdge> half_edges = sorted_half_edges(faces);
  if (half_edges.size() % 2 != 0) return false;
  for (std::size_t i = 0; i < half_edges.size(); i += 2) {
    const HalfEdge &first = half_edges[i], &second = half_edges[i + 1];
    const bool paired = first.a == second.a && first.b == second.b && first.forward != second.forward;
    const bool crowded = i + 2 < half_edges.size() && half_edges[i + 2].a == first.a && half_edges[i + 2].b == first.b;
    if (!paired || crowded) return false;
  }
  return true;
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
