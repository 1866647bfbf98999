#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/cgal_mesh.hpp>

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <cmath>
#include <exception>
#include <iterator>
#include <vector>

namespace gracilis {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

constexpr std::size_t most_cubic_edges = 200;  ///< of a hole: its filling may take time by the third power

struct WatchedFilling : pmp::Hole_filling::Default_visitor {
  explicit WatchedFilling(const TimeLimit& until) : limit(&until) {}
  void quadratic_step() const { limit->check(); }
  void cubic_step() const { limit->check(); }
  const TimeLimit* limit;
};

bool fill_hole(CgalMesh& surface, CgalMesh::Halfedge_index border, bool fair, std::size_t edges,
               const TimeLimit& limit) {
  std::vector<CgalMesh::Face_index> faces;
  std::vector<CgalMesh::Vertex_index> vertices;
  const WatchedFilling watch(limit);
  const auto how = CGAL::parameters::visitor(std::cref(watch)).do_not_use_cubic_algorithm(edges > most_cubic_edges);
  if (fair)
    pmp::triangulate_refine_and_fair_hole(surface, border, std::back_inserter(faces), std::back_inserter(vertices),
                                          how);
  else
    pmp::triangulate_and_refine_hole(surface, border, std::back_inserter(faces), std::back_inserter(vertices), how);
  return !faces.empty();
}

}  // namespace

Index fill_holes(TriangleMesh& mesh, Real longest, bool fair, const TimeLimit& limit) {
  std::optional<CgalMesh> given = to_cgal(mesh);
  if (!given) return 0;
  CgalMesh& surface = *given;
  std::vector<CgalMesh::Halfedge_index> borders;
  pmp::extract_boundary_cycles(surface, std::back_inserter(borders));
  Index filled = 0;
  for (const CgalMesh::Halfedge_index border : borders) {
    limit.check();
    Real length = 0;
    std::size_t edges = 0;
    for (const auto h : CGAL::halfedges_around_face(border, surface)) {
      length += std::sqrt(CGAL::squared_distance(surface.point(surface.source(h)), surface.point(surface.target(h))));
      ++edges;
    }
    if (length > longest || edges < 3) continue;
    const CgalMesh before = surface;
    try {
      if (fill_hole(surface, border, fair, edges, limit)) ++filled;
    } catch (const Error&) {
      throw;
    } catch (const std::exception&) {
      surface = before;  // CGAL says that it cannot
    }
  }
  if (filled > 0) {
    surface.collect_garbage();
    mesh = from_cgal(surface);
  }
  return filled;
}

}  // namespace gracilis
