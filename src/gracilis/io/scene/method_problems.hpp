#pragma once

#include <gracilis/core/errors.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis {

/// What makes a scene unfit for its method: all that `validate_method` finds, and distance fields of the method's own
/// that would take more memory than machines have.
std::vector<Problem> method_problems(const Scene& scene);

}  // namespace gracilis
