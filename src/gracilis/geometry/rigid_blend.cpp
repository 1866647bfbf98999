#include <gracilis/geometry/rigid_blend.hpp>

namespace gracilis {

RigidTransform blend(std::span<const RigidTransform> motions, std::span<const Real> weights) {
  const Eigen::Quaterniond pivot(motions[0].linear());
  Eigen::Vector4d real = Eigen::Vector4d::Zero(), dual = Eigen::Vector4d::Zero();
  for (std::size_t i = 0; i < motions.size(); ++i) {
    Eigen::Quaterniond q(motions[i].linear());
    if (q.dot(pivot) < 0) q.coeffs() = -q.coeffs();  // q and -q are one rotation: stay on one side
    const Vec3 t = motions[i].translation();
    const Eigen::Quaterniond half = Eigen::Quaterniond(0, t.x() / 2, t.y() / 2, t.z() / 2) * q;
    real += weights[i] * q.coeffs();
    dual += weights[i] * half.coeffs();
  }
  const Real length = real.norm();
  const Eigen::Quaterniond rotation(Eigen::Vector4d(real / length));
  const Eigen::Quaterniond half(Eigen::Vector4d(dual / length));
  RigidTransform result = RigidTransform::Identity();
  result.linear() = rotation.toRotationMatrix();
  result.translation() = 2 * (half * rotation.conjugate()).vec();
  return result;
}

}  // namespace gracilis
