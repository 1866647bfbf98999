#include <gracilis/geometry/screw.hpp>

#include <cmath>

namespace gracilis {

static constexpr Real no_turn = 1e-9;  ///< rad

Screw screw_of(const RigidTransform& motion) {
  const Eigen::AngleAxisd turn(motion.linear());
  if (turn.angle() < no_turn) return {Vec3::UnitX(), 0, motion.translation().norm()};
  return {turn.axis(), turn.angle(), turn.axis().dot(motion.translation())};
}

RigidTransform share_of_screw(const RigidTransform& motion, Real t) {
  const Screw screw = screw_of(motion);
  RigidTransform share = RigidTransform::Identity();
  if (screw.angle == 0) {
    share.translation() = t * motion.translation();
    return share;
  }
  const Vec3 along = screw.slide * screw.axis, across = motion.translation() - along;
  // The point of the axis that is nearest to the origin: (I - R) center = across.
  const Vec3 center = (across + screw.axis.cross(across) / std::tan(screw.angle / 2)) / 2;
  share.linear() = Eigen::AngleAxisd(t * screw.angle, screw.axis).toRotationMatrix();
  share.translation() = center - share.linear() * center + t * along;
  return share;
}

}  // namespace gracilis
