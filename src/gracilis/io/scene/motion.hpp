#pragma once

#include <gracilis/io/scene/scene_in_progress.hpp>
#include <gracilis/io/toml_reader.hpp>

/// [motion].
namespace gracilis::sections {

/// The table; what is wrong with it goes to the reader's problems.
MotionDescription read_motion(TomlReader table);

/// Sets the scene's motion from its table file or through its key poses. Columns of a file that are no coordinates of
/// the scene are left out; coordinates without a column are warned about, or a problem where they were asked for.
/// Precondition: the scene has its joints.
void add_motion(SceneInProgress& progress);

}  // namespace gracilis::sections
