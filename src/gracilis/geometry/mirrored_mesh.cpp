#include <gracilis/geometry/mirrored_mesh.hpp>

namespace gracilis {

Points mirrored(const Points& points, const Vec3& across) {
  return points - 2 * across * (across.transpose() * points);
}

TriangleMesh mirrored(const TriangleMesh& mesh, const Vec3& across) {
  TriangleMesh result{mirrored(mesh.vertices, across), mesh.faces};
  result.faces.row(1).swap(result.faces.row(2));
  return result;
}

}  // namespace gracilis
