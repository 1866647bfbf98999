#pragma once

#include <gracilis/core/types.hpp>

#include <span>
#include <vector>

namespace gracilis {

/// Rigid motions as dual quaternions of one side, ready to be blended.
struct RigidBlend {
  std::vector<Eigen::Vector4d> real, dual;
};
/// In the order of the motions.
RigidBlend prepare_blend(std::span<const RigidTransform> motions);

/// The weighted mean of rigid motions by dual quaternions (Kavan et al. 2008): rigid itself, equal to the motion when
/// all are equal, and independent of the coordinate frame. Preconditions: as many weights as motions, at least one;
/// weights not negative, sum 1; rotations less than half a turn apart.
RigidTransform blend(const RigidBlend& motions, std::span<const Real> weights);

}  // namespace gracilis
