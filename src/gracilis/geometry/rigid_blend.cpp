#include <gracilis/geometry/rigid_blend.hpp>

namespace gracilis {

RigidBlend prepare_blend(std::span<const RigidTransform> motions) {
  RigidBlend blend;
  for (const RigidTransform& motion : motions) {
    Eigen::Quaterniond q(motion.linear());
    // q and -q are one rotation: stay on one side
    if (!blend.real.empty() && q.coeffs().dot(blend.real.front()) < 0) q.coeffs() = -q.coeffs();
    const Vec3 t = motion.translation();
    blend.real.push_back(q.coeffs());
    blend.dual.push_back((Eigen::Quaterniond(0, t.x() / 2, t.y() / 2, t.z() / 2) * q).coeffs());
  }
  return blend;
}

RigidTransform blend(const RigidBlend& motions, std::span<const Real> weights) {
  Eigen::Vector4d real = Eigen::Vector4d::Zero(), dual = Eigen::Vector4d::Zero();
  for (std::size_t i = 0; i < motions.real.size(); ++i) {
    real += weights[i] * motions.real[i];
    dual += weights[i] * motions.dual[i];
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
