#pragma once

#include <gracilis/core/errors.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis {

/// What is wrong with the bodies that muscles carry: that they, the muscles or the vertices of their patches do not
/// exist, that something else moves them, or that a muscle lies on itself by way of others. Part of `validate`.
std::vector<Problem> muscle_body_problems(const Scene& scene);

}  // namespace gracilis
