#include <gracilis/geometry/polygon_area.hpp>

#include <Eigen/Geometry>

namespace gracilis {

Vec3 polygon_area_vector(const Points& corners) {
  Vec3 sum = Vec3::Zero();
  const Vec3 first = corners.col(0);
  for (Eigen::Index i = 1; i + 1 < corners.cols(); ++i)
    sum += Vec3(corners.col(i) - first).cross(Vec3(corners.col(i + 1) - first));
  return sum / 2;
}

}  // namespace gracilis
