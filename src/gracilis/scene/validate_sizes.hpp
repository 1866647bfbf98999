#pragma once

#include <gracilis/core/errors.hpp>
#include <gracilis/scene/scene.hpp>

#include <optional>
#include <vector>

namespace gracilis {

/// Settings that each lie within their range and together ask for more memory than machines have: grids of distance
/// fields, points of fibers. Estimated from the scene before anything is made. Part of `validate`.
std::vector<Problem> size_problems(const Scene& scene);

/// Distance fields of all bones by `settings` that take more nodes than are ever made; none where they do not. `asked`
/// says where, what asks for them, and the remedy.
std::optional<Problem> grid_problem(const Scene& scene, const DistanceFieldSettings& settings, Problem asked);

}  // namespace gracilis
