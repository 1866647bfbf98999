#include <gracilis/methods/tissue/point_energy.hpp>

#include <cmath>

namespace gracilis::tissue {

Matrix3 spring_hessian(Real stiffness) { return stiffness * Matrix3::Identity(); }

Matrix3 tie_hessian(const Vec3& offset, const Vec3& along, Real stiffness, Real yield) {
  const Matrix3 across = Matrix3::Identity() - along * along.transpose();
  const Vec3 e = across * offset;
  const Real root = std::sqrt(1 + e.squaredNorm() / (yield * yield));
  return stiffness / root * (across - e * e.transpose() / (root * root * yield * yield));
}

Matrix3 contact_hessian(Real distance, const Vec3& normal, Real gap, Real stiffness) {
  if (!(distance < gap)) return Matrix3::Zero();
  return stiffness * normal * normal.transpose();
}

}  // namespace gracilis::tissue
