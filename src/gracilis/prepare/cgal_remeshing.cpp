#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/cgal_mesh.hpp>

#include <CGAL/Polygon_mesh_processing/remesh.h>

namespace gracilis {

TriangleMesh remesh_isotropic(const TriangleMesh& mesh, Real edge_length, int iterations) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  CgalMesh surface = to_cgal(mesh);
  pmp::isotropic_remeshing(
      surface.faces(), edge_length, surface,
      CGAL::parameters::number_of_iterations(static_cast<unsigned>(iterations)).number_of_relaxation_steps(3));
  surface.collect_garbage();
  return from_cgal(surface);
}

}  // namespace gracilis
