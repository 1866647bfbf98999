#include <gracilis/geometry/cross_section.hpp>

#include <gracilis/geometry/isocontours.hpp>

#include <cmath>
#include <limits>

namespace gracilis {

Real cross_section_area(const TriangleMesh& surface, const MeshTopology& topology, const Vec3& point,
                        const Vec3& normal) {
  const Eigen::VectorXd height = (surface.vertices.colwise() - point).transpose() * normal;
  Real nearest = std::numeric_limits<Real>::infinity(), area = 0;
  for (const Points& loop : isocontours(surface, topology, height, 0)) {
    const Vec3 middle = loop.rowwise().mean();
    if ((middle - point).norm() >= nearest) continue;
    nearest = (middle - point).norm();
    Vec3 sum = Vec3::Zero();
    for (Eigen::Index i = 0, j = loop.cols() - 1; i < loop.cols(); j = i++)
      sum += (loop.col(j) - middle).cross(loop.col(i) - middle);
    area = std::abs(sum.dot(normal)) / 2;
  }
  return area;
}

}  // namespace gracilis
