#include <gracilis/geometry/vertex_normals.hpp>

#include <gracilis/geometry/measures.hpp>

namespace gracilis {

Points vertex_normals(const Points& vertices, const Eigen::Matrix3Xi& faces) {
  Points normals = Points::Zero(3, vertices.cols());
  for (Index f = 0; f < static_cast<Index>(faces.cols()); ++f) {
    const Vec3 area = area_vector(vertices, faces.col(f));
    for (int k = 0; k < 3; ++k) normals.col(faces(k, f)) += area;
  }
  for (Index v = 0; v < static_cast<Index>(normals.cols()); ++v)
    if (const Real length = normals.col(v).norm(); length > 0) normals.col(v) /= length;
  return normals;
}

}  // namespace gracilis
