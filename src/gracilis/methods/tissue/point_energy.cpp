#include <gracilis/methods/tissue/point_energy.hpp>

#include <cmath>

namespace gracilis::tissue {

PointState spring(const Vec3& offset, Real stiffness) {
  return {stiffness / 2 * offset.squaredNorm(), stiffness * offset, stiffness * Matrix3::Identity()};
}

PointState tie(const Vec3& offset, const Vec3& along, Real stiffness, Real yield) {
  const Matrix3 across = Matrix3::Identity() - along * along.transpose();
  const Vec3 e = across * offset;
  const Real root = std::sqrt(1 + e.squaredNorm() / (yield * yield));
  const Real now = stiffness / root;
  return {stiffness * yield * yield * (root - 1), now * e,
          now * across - now / (root * root * yield * yield) * e * e.transpose()};
}

PointState contact(Real distance, const Vec3& normal, Real gap, Real stiffness) {
  const Real depth = gap - distance;
  if (!(depth > 0)) return {};
  return {stiffness / 2 * depth * depth, -stiffness * depth * normal, stiffness * normal * normal.transpose()};
}

}  // namespace gracilis::tissue
