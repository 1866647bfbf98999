#include <gracilis/simulate/pose_steps.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

namespace {

constexpr Real no_turn = 1e-9;  ///< rad

struct Screw {
  Vec3 axis = Vec3::UnitX();
  Real angle = 0, slide = 0;
};

Screw screw_of(const RigidTransform& motion) {
  const Eigen::AngleAxisd turn(motion.linear());
  if (turn.angle() < no_turn) return {Vec3::UnitX(), 0, motion.translation().norm()};
  return {turn.axis(), turn.angle(), turn.axis().dot(motion.translation())};
}

}  // namespace

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

std::vector<std::vector<RigidTransform>> pose_steps(const std::vector<RigidTransform>& from,
                                                    const std::vector<RigidTransform>& to, Real largest_turn,
                                                    Real largest_slide) {
  Real wanted = 1;
  for (std::size_t a = 0; a < from.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const RigidTransform before = from[b].inverse() * from[a], now = to[b].inverse() * to[a];
      const Screw screw = screw_of(now * before.inverse());
      wanted = std::max({wanted, screw.angle / largest_turn, std::abs(screw.slide) / largest_slide});
    }
  const int count = static_cast<int>(std::ceil(wanted - 1e-6));
  std::vector<std::vector<RigidTransform>> steps(static_cast<std::size_t>(count), from);
  for (std::size_t body = 0; body < from.size(); ++body) {
    const RigidTransform motion = to[body] * from[body].inverse();
    for (int i = 0; i + 1 < count; ++i)
      steps[static_cast<std::size_t>(i)][body] = share_of_screw(motion, static_cast<Real>(i + 1) / count) * from[body];
  }
  steps.back() = to;
  return steps;
}

}  // namespace gracilis
