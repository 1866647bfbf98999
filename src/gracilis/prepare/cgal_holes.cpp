#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/cgal_mesh.hpp>

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <cmath>
#include <iterator>
#include <vector>

namespace gracilis {

Index fill_holes(TriangleMesh& mesh, Real longest) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  CgalMesh surface = to_cgal(mesh);
  std::vector<CgalMesh::Halfedge_index> borders;
  pmp::extract_boundary_cycles(surface, std::back_inserter(borders));
  Index filled = 0;
  for (const CgalMesh::Halfedge_index border : borders) {
    Real length = 0;
    for (const auto h : CGAL::halfedges_around_face(border, surface))
      length += std::sqrt(CGAL::squared_distance(surface.point(surface.source(h)), surface.point(surface.target(h))));
    if (length > longest) continue;
    std::vector<CgalMesh::Face_index> faces;
    std::vector<CgalMesh::Vertex_index> vertices;
    pmp::triangulate_refine_and_fair_hole(surface, border, std::back_inserter(faces), std::back_inserter(vertices));
    if (!faces.empty()) ++filled;
  }
  if (filled > 0) mesh = from_cgal(surface);
  return filled;
}

}  // namespace gracilis
