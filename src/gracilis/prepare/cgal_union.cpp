#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/cgal_mesh.hpp>
#include <gracilis/prepare/solids.hpp>

#include <CGAL/Polygon_mesh_processing/corefinement.h>

#include <exception>

namespace gracilis {

static bool encloses_something(const TriangleMesh& mesh) {
  const MeshReport report = inspect_mesh(mesh);
  return bounds_a_solid(report) && report.volume > 0;
}

std::optional<TriangleMesh> exact_union(const TriangleMesh& a, const TriangleMesh& b) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  if (!encloses_something(a) || !encloses_something(b)) return std::nullopt;
  std::optional<CgalMesh> first = to_cgal(a), second = to_cgal(b);
  if (!first || !second) return std::nullopt;
  try {
    CgalMesh both;
    const auto strict = CGAL::parameters::throw_on_self_intersection(true);
    if (!pmp::corefine_and_compute_union(*first, *second, both, strict)) return std::nullopt;
    both.collect_garbage();
    return from_cgal(both);
  } catch (const std::exception&) {
    return std::nullopt;  // CGAL says that it cannot
  }
}

}  // namespace gracilis
