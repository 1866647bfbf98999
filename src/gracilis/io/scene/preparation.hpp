#pragma once

#include <gracilis/io/scene/scene_in_progress.hpp>
#include <gracilis/scene/preparation.hpp>

#include <vector>

namespace gracilis {

/// pull_only (scene/preparation.hpp); throws ConfigurationError where a name is no muscle's. `subject`: where `apart`
/// stands.
void pull_only_known(std::vector<NamedSurface>& muscles, const std::vector<std::string>& apart,
                     const std::string& subject);

}  // namespace gracilis

/// [prepare].
namespace gracilis::sections {

/// The muscles' surfaces by name, m, with what each is pulled apart from; in the scene's order.
std::vector<NamedSurface> muscle_surfaces(const SceneInProgress& progress);
/// Likewise of the bones.
std::vector<NamedSurface> bone_surfaces(const SceneInProgress& progress);

/// Puts prepared surfaces in the place of the muscles' own. Precondition: the scene is described as to be prepared.
/// Throws ConfigurationError where an attachment lists vertices, and what cached_preparation throws.
void prepare_muscles(SceneInProgress& progress);

}  // namespace gracilis::sections
