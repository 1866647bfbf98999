#pragma once

#include <gracilis/core/types.hpp>

#include <vector>

namespace gracilis {

/// Where bodies are on the way from one pose to another, each along its own screw, `to` itself last: as many steps as
/// it takes for none to turn against another by more than `largest_turn` (rad), or to slide by more than
/// `largest_slide` (m). At least one. Both have as many bodies. Throws QualityError where more than 20,000 steps are
/// needed (fewer for thousands of bodies), or where a pose is not finite.
std::vector<std::vector<RigidTransform>> pose_steps(const std::vector<RigidTransform>& from,
                                                    const std::vector<RigidTransform>& to, Real largest_turn,
                                                    Real largest_slide);

}  // namespace gracilis
