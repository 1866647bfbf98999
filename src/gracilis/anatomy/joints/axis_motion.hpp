#pragma once

#include <gracilis/scene/scene.hpp>

namespace gracilis {

/// The motion of an axis' coordinate, in the joint's frame: a turn by `value` (rad) about it, or a shift (m) along it.
inline RigidTransform axis_motion(const JointAxis& axis, Real value) {
  if (axis.translation) return RigidTransform(Eigen::Translation3d(value * axis.axis));
  return RigidTransform(Eigen::AngleAxisd(value, axis.axis));
}

}  // namespace gracilis
