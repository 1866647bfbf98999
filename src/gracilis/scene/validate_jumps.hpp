#pragma once

#include <gracilis/core/errors.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis {

/// Translations that a motion takes farther from one row to the next than bodies can be followed in small steps; the
/// first of each coordinate. Precondition: the motion's table is finite, with a column per coordinate.
std::vector<Problem> jump_problems(const Scene& scene);

}  // namespace gracilis
