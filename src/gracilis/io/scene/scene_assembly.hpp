#pragma once

#include <gracilis/io/scene/scene_in_progress.hpp>

/// From a scene's description to its values, a stage after the other.
namespace gracilis::sections {

/// A scene with what needs no file. The description and the options must outlive it.
SceneInProgress begin_scene(const SceneDescription& description, const SceneOptions& options);

/// Bodies and all that stands in files, muscles as they are there.
void read_surfaces(SceneInProgress& progress);

/// All of it, checked.
LoadedScene finish_scene(SceneInProgress progress);

}  // namespace gracilis::sections
