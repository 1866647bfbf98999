#pragma once

#include <gracilis/anatomy/builtin/builtin_muscles.hpp>

#include <vector>

namespace gracilis::builtin_elbow_shapes {

/// The plans in the order in which the muscles are made: deep ones first, the others make room for them.
std::vector<builtin_shapes::MusclePlan> elbow_muscle_plans();

}  // namespace gracilis::builtin_elbow_shapes
