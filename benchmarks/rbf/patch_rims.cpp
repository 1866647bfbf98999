#include "patch_rims.hpp"

#include <gracilis/geometry/topology.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace gracilis {

namespace {

/// The vertices around each rim of an open surface, in their order.
std::vector<std::vector<Index>> rims(const MeshTopology& topology) {
  std::map<Index, Index> next;  // of a rim's vertex, as the face beside it runs
  for (const MeshEdge& edge : topology.edges) {
    if (edge.left >= 0 && edge.right < 0) next[edge.a] = edge.b;
    if (edge.right >= 0 && edge.left < 0) next[edge.b] = edge.a;
  }
  std::vector<std::vector<Index>> found;
  while (!next.empty()) {
    std::vector<Index> rim;
    for (auto at = next.begin(); at != next.end(); at = next.find(rim.back())) {
      rim.push_back(at->second);
      next.erase(at);
    }
    found.push_back(std::move(rim));
  }
  return found;
}

/// Points along a rim as far apart as measured ones are, about 8 mm, but 8 to 40 of them.
Points along_rim(const TriangleMesh& patch, const std::vector<Index>& rim) {
  std::vector<Real> way = {0};
  for (std::size_t i = 0; i < rim.size(); ++i)
    way.push_back(way.back() + (patch.vertices.col(rim[(i + 1) % rim.size()]) - patch.vertices.col(rim[i])).norm());
  const int count = std::clamp(static_cast<int>(std::lround(way.back() / 0.008)), 8, 40);
  Points points(3, count);
  for (int k = 0; k < count; ++k) {
    const Real wanted = way.back() * k / count;
    const auto i = static_cast<std::size_t>(std::upper_bound(way.begin(), way.end(), wanted) - way.begin()) - 1;
    const Vec3 a = patch.vertices.col(rim[i]), b = patch.vertices.col(rim[(i + 1) % rim.size()]);
    points.col(k) = a + (wanted - way[i]) / (way[i + 1] - way[i]) * (b - a);
  }
  return points;
}

/// What is joined to a vertex by edges.
Points piece_with(const TriangleMesh& patch, const VertexStars& stars, Index start) {
  std::vector<char> seen(static_cast<std::size_t>(patch.vertex_count()), 0);
  std::vector<Index> piece = {start};
  seen[static_cast<std::size_t>(start)] = 1;
  for (std::size_t next = 0; next < piece.size(); ++next) {
    const auto v = static_cast<std::size_t>(piece[next]);
    for (Index i = stars.offsets[v]; i < stars.offsets[v + 1]; ++i) {
      const Index neighbor = stars.neighbors[static_cast<std::size_t>(i)];
      if (!seen[static_cast<std::size_t>(neighbor)]) piece.push_back(neighbor);
      seen[static_cast<std::size_t>(neighbor)] = 1;
    }
  }
  return patch.vertices(Eigen::all, piece);
}

}  // namespace

std::vector<PatchRim> patch_rims(const TriangleMesh& patches, std::size_t least) {
  const MeshTopology topology = build_topology(patches.faces, patches.vertex_count());
  std::vector<PatchRim> found;
  for (const std::vector<Index>& rim : rims(topology))
    if (rim.size() >= least)
      found.push_back({along_rim(patches, rim), piece_with(patches, topology.stars, rim.front())});
  return found;
}

}  // namespace gracilis
