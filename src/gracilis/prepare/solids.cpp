#include <gracilis/prepare/solids.hpp>

#include <gracilis/geometry/measures.hpp>
#include <gracilis/prepare/cgal.hpp>

#include <array>
#include <cmath>

namespace gracilis {

bool bounds_a_solid(const MeshReport& report) {
  return report.is_closed() && report.is_manifold() && report.is_oriented();
}

bool is_solid(const MeshReport& report) { return bounds_a_solid(report) && !report.degenerate_faces; }

bool is_solid(const TriangleMesh& mesh) {
  const MeshReport report = inspect_mesh(mesh);
  return is_solid(report) && report.volume > 0;
}

Real volume_of(const TriangleMesh& mesh) { return enclosed_volume(mesh.vertices, mesh.faces); }

Real volume_error(const TriangleMesh& mesh, Real volume) { return std::abs(volume_of(mesh) / volume - 1); }

bool cuts_itself(const TriangleMesh& mesh, const TimeLimit& limit) {
  const std::array<const TriangleMesh*, 1> one = {&mesh};
  return !intersecting_faces(one, false, limit).empty();
}

}  // namespace gracilis
