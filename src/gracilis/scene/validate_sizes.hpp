#pragma once

#include <gracilis/core/errors.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis {

/// Settings that each lie within their range and together ask for more memory than machines have: grids of distance
/// fields, points of fibers. Estimated from the scene before anything is made. Part of `validate`.
std::vector<Problem> size_problems(const Scene& scene);

}  // namespace gracilis
