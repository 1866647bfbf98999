#pragma once

#include <gracilis/scene/fiber_actions.hpp>
#include <gracilis/scene/twist.hpp>
#include <gracilis/strings/relaxation.hpp>

#include <vector>

namespace gracilis::strings {

/// Lets a copy of the strings come to rest in the state's pose, and differentiates their equilibrium there (implicit
/// function theorem; docs/mathematics.md, "Moment arms of strings"). `coordinates`: per coordinate the motion of every
/// body per unit of it. Without wrenches there are none in the result. Precondition: as many twists as the state has
/// bodies.
FiberActions string_actions(const MuscleStrings& muscle, const BoneDistances& bones, const StringState& state,
                            const std::vector<std::vector<Twist>>& coordinates, bool with_wrenches = true);

}  // namespace gracilis::strings
