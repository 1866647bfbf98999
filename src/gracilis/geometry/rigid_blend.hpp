#pragma once

#include <gracilis/core/types.hpp>

#include <span>

namespace gracilis {

/// The weighted mean of rigid motions by dual quaternions (Kavan et al. 2008): rigid itself, equal to the motion when
/// all are equal, and independent of the coordinate frame. Preconditions: as many weights as motions, at least one;
/// weights not negative, sum 1; rotations less than half a turn apart.
RigidTransform blend(std::span<const RigidTransform> motions, std::span<const Real> weights);

}  // namespace gracilis
