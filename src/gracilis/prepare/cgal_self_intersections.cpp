#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/cgal_mesh.hpp>

#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>

namespace gracilis {

bool remove_self_intersections(TriangleMesh& mesh) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  CgalMesh surface = to_cgal(mesh);
  const bool clean = pmp::experimental::remove_self_intersections(surface, CGAL::parameters::preserve_genus(false));
  surface.collect_garbage();
  mesh = from_cgal(surface);
  return clean;
}

}  // namespace gracilis
