#pragma once

#include <gracilis/core/errors.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis {

/// What is wrong with the lines that muscles' surfaces were made about: points without bodies, paths without places,
/// and sections that do not fit the surface.
std::vector<Problem> line_problems(const Scene& scene);

}  // namespace gracilis
