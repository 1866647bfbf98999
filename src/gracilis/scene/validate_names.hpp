#pragma once

#include <gracilis/core/errors.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis {

/// What is wrong with names in a scene: they become files (bones and muscles, both in one folder) and labels of columns
/// (coordinates and muscles, both in one table), where each must be another one. Part of `validate`.
std::vector<Problem> name_problems(const Scene& scene);

}  // namespace gracilis
