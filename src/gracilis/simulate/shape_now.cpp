#include <gracilis/simulate/shape_now.hpp>

#include <gracilis/core/group_by_key.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/point_triangle.hpp>

#include <cmath>
#include <limits>
#include <utility>

namespace gracilis {

FacesAround faces_around(const Eigen::Matrix3Xi& faces, Index vertex_count) {
  GroupedByKey corners = group_by_key({faces.data(), static_cast<std::size_t>(faces.size())}, vertex_count);
  for (Index& corner : corners.items) corner /= 3;
  return {std::move(corners.begins), std::move(corners.items)};
}

ShapeNow::ShapeNow(const Points& vertices, const Eigen::Matrix3Xi& faces, const FacesAround& around)
    : vertices_(vertices), faces_(faces), around_(around), box_(bounding_box(vertices)), tree_(vertices) {}

Vec3 ShapeNow::normal_at(Index vertex) const {
  Vec3 normal = Vec3::Zero();
  const auto v = static_cast<std::size_t>(vertex);
  for (Index i = around_.offsets[v]; i < around_.offsets[v + 1]; ++i)
    normal += area_vector(vertices_, faces_.col(around_.faces[static_cast<std::size_t>(i)]));
  return normal.stableNormalized();
}

Real ShapeNow::gap(const Vec3& p) const {
  constexpr std::size_t nearest_vertices = 3;
  constexpr Real deepest = 0.015;  // m
  Real nearest2 = std::numeric_limits<Real>::infinity();
  Vec3 offset = Vec3::Zero(), outward = Vec3::Zero();
  for (const Index vertex : tree_.query(p, nearest_vertices)) {
    const auto v = static_cast<std::size_t>(vertex);
    for (Index i = around_.offsets[v]; i < around_.offsets[v + 1]; ++i) {
      const Eigen::Vector3i corners = faces_.col(around_.faces[static_cast<std::size_t>(i)]);
      const Vec3 a = vertices_.col(corners[0]), b = vertices_.col(corners[1]), c = vertices_.col(corners[2]);
      const Vec3 w = nearest_barycentric(p, a, b, c), away = p - (w[0] * a + w[1] * b + w[2] * c);
      if (away.squaredNorm() >= nearest2) continue;
      nearest2 = away.squaredNorm();
      offset = away;
      outward = Vec3::Zero();
      for (int k = 0; k < 3; ++k) outward += w[k] * normal_at(corners[k]);
    }
  }
  const Real distance = std::sqrt(nearest2);
  return offset.dot(outward) < 0 && distance < deepest ? 0 : distance;
}

}  // namespace gracilis
