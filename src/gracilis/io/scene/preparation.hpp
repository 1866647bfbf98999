#pragma once

#include <gracilis/io/scene/scene_in_progress.hpp>
#include <gracilis/scene/preparation.hpp>

#include <vector>

/// [prepare].
namespace gracilis::sections {

std::vector<NamedSurface> muscle_surfaces(const SceneInProgress& progress);
std::vector<NamedSurface> bone_surfaces(const SceneInProgress& progress);

/// Puts prepared surfaces in the place of the muscles' own. Precondition: the scene is described as to be prepared.
/// Throws ConfigurationError where an attachment lists vertices, and what cached_preparation throws.
void prepare_muscles(SceneInProgress& progress);

}  // namespace gracilis::sections
