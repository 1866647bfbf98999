#include <gracilis/geometry/surface_region.hpp>

#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/nearest_points.hpp>
#include <gracilis/geometry/shortest_paths.hpp>

#include <algorithm>
#include <set>
#include <utility>

namespace gracilis {

namespace {

using Edge = std::pair<Index, Index>;

/// The edges of the shortest ways along the surface from point to point of the outline and back to the first.
std::set<Edge> cut_of(const TriangleMesh& surface, const MeshTopology& topology, const Points& outline) {
  const NearestPoints vertices(surface.vertices);
  const EdgeGraph graph = length_graph(surface.vertices, topology);
  std::set<Edge> cut;
  const auto count = static_cast<Index>(outline.cols());
  for (Index i = 0; i < count; ++i) {
    const std::vector<Index> path =
        shortest_path(graph, vertices.nearest(outline.col(i)), vertices.nearest(outline.col((i + 1) % count)));
    for (std::size_t k = 1; k < path.size(); ++k) cut.insert(std::minmax(path[k - 1], path[k]));
  }
  return cut;
}

}  // namespace

std::vector<char> faces_inside(const TriangleMesh& surface, const Points& outline) {
  const auto faces = static_cast<std::size_t>(surface.face_count());
  if (outline.cols() < 3) return std::vector<char>(faces, 0);
  const MeshTopology topology = build_topology(surface.faces, surface.vertex_count());
  const std::set<Edge> cut = cut_of(surface, topology, outline);
  std::vector<std::vector<Index>> beside(faces);
  for (const MeshEdge& edge : topology.edges) {
    if (edge.left < 0 || edge.right < 0 || cut.contains({edge.a, edge.b})) continue;
    beside[static_cast<std::size_t>(edge.left)].push_back(edge.right);
    beside[static_cast<std::size_t>(edge.right)].push_back(edge.left);
  }
  // Pieces that touch the cut count; others are parts of a surface in several parts.
  std::vector<char> at_cut(faces, 0);
  for (const MeshEdge& edge : topology.edges)
    if (cut.contains({edge.a, edge.b}))
      for (const Index face : {edge.left, edge.right})
        if (face >= 0) at_cut[static_cast<std::size_t>(face)] = 1;
  std::vector<Index> piece(faces, -1);
  std::vector<Real> areas;
  std::vector<char> touches;
  for (std::size_t f = 0; f < faces; ++f) {
    if (piece[f] >= 0) continue;
    std::vector<Index> open = {static_cast<Index>(f)};
    piece[f] = static_cast<Index>(areas.size());
    areas.push_back(0);
    touches.push_back(0);
    while (!open.empty()) {
      const Index at = open.back();
      open.pop_back();
      areas.back() += area_vector(surface.vertices, surface.faces.col(at)).norm() / 2;
      touches.back() |= at_cut[static_cast<std::size_t>(at)];
      for (const Index next : beside[static_cast<std::size_t>(at)])
        if (Index& mark = piece[static_cast<std::size_t>(next)]; mark < 0) mark = piece[f], open.push_back(next);
    }
  }
  Index outside = -1;
  for (std::size_t p = 0; p < areas.size(); ++p)
    if (touches[p] && (outside < 0 || areas[p] > areas[static_cast<std::size_t>(outside)]))
      outside = static_cast<Index>(p);
  std::vector<char> inside(faces, 0);
  for (std::size_t f = 0; f < faces; ++f)
    inside[f] = touches[static_cast<std::size_t>(piece[f])] && piece[f] != outside;
  return inside;
}

Real marked_area(const TriangleMesh& surface, const std::vector<char>& marked) {
  Real area = 0;
  for (Index f = 0; f < surface.face_count(); ++f)
    if (marked[static_cast<std::size_t>(f)]) area += area_vector(surface.vertices, surface.faces.col(f)).norm() / 2;
  return area;
}

}  // namespace gracilis
