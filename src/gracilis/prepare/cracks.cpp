#include <gracilis/prepare/cracks.hpp>

#include <gracilis/geometry/half_edges.hpp>
#include <gracilis/geometry/nearest_points.hpp>

#include <algorithm>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace gracilis {
namespace {

constexpr Real first_reach = 1e-4, last_reach = 0.2, growth = 5;  ///< the first two of the mean edge

/// Edges with one face, and how long edges are on average, m.
struct OpenEdges {
  std::vector<std::pair<Index, Index>> edges;
  Real mean_length = 0;
};

OpenEdges open_edges_of(const TriangleMesh& mesh) {
  OpenEdges open;
  Index count = 0;
  for_each_edge(sorted_half_edges(mesh.faces), [&](std::span<const HalfEdge> sides) {
    open.mean_length += (mesh.vertices.col(sides[0].low) - mesh.vertices.col(sides[0].high)).norm();
    ++count;
    if (sides.size() == 1) open.edges.emplace_back(sides[0].low, sides[0].high);
  });
  if (count > 0) open.mean_length /= count;
  return open;
}

/// Each border vertex becomes the first one within reach that is not its neighbor, in the order of their numbers.
Index join_borders(TriangleMesh& mesh, const OpenEdges& open, Real reach) {
  std::set<std::pair<Index, Index>> neighbors;
  std::set<Index> border;
  for (const auto& [low, high] : open.edges) {
    neighbors.emplace(low, high);
    border.insert({low, high});
  }
  const std::vector<Index> vertices(border.begin(), border.end());
  const NearestPoints near(mesh.vertices(Eigen::all, vertices));
  std::vector<Index> into(static_cast<std::size_t>(mesh.vertex_count()));
  for (std::size_t v = 0; v < into.size(); ++v) into[v] = static_cast<Index>(v);
  Index joined = 0;
  for (const Index v : vertices)
    for (const Index k : near.within(mesh.vertices.col(v), reach)) {
      const Index other = vertices[static_cast<std::size_t>(k)];
      if (other >= v) break;
      if (into[static_cast<std::size_t>(other)] != other || neighbors.count({other, v})) continue;
      into[static_cast<std::size_t>(v)] = other;
      ++joined;
      break;
    }
  Index kept = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    Eigen::Vector3i face;
    for (int k = 0; k < 3; ++k) face[k] = into[static_cast<std::size_t>(mesh.faces(k, f))];
    if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) mesh.faces.col(kept++) = face;
  }
  mesh.faces.conservativeResize(3, kept);
  return joined;
}

}  // namespace

Index close_cracks(TriangleMesh& mesh) {
  const OpenEdges before = open_edges_of(mesh);
  TriangleMesh best;
  std::size_t fewest = before.edges.size() / 2 + 1;
  Index most = 0;
  for (Real reach = first_reach; reach <= last_reach && fewest > 0; reach *= growth) {
    TriangleMesh closed = mesh;
    const Index joined = join_borders(closed, before, reach * before.mean_length);
    const std::size_t left = open_edges_of(closed).edges.size();
    if (joined == 0 || left >= fewest) continue;
    best = std::move(closed);
    fewest = left;
    most = joined;
  }
  if (most > 0) mesh = std::move(best);
  return most;
}

}  // namespace gracilis
