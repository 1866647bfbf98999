#pragma once

#include <gracilis/io/scene/scene_in_progress.hpp>
#include <gracilis/io/toml_reader.hpp>

/// [[joint_control_units]].
namespace gracilis::sections {

/// One table; what is wrong with it goes to the reader's problems.
ControlUnitDescription read_control_unit(TomlReader table);

/// Adds the unit with its samples, which are joined from a motion and results where they stand in no file of their own.
/// Precondition: the scene has its joints and muscles.
void add_control_unit(SceneInProgress& progress, const ControlUnitDescription& description);

}  // namespace gracilis::sections
