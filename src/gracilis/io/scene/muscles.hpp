#pragma once

#include <gracilis/io/scene/scene_in_progress.hpp>
#include <gracilis/io/scene/settings.hpp>
#include <gracilis/io/scene/surfaces.hpp>
#include <gracilis/io/toml_reader.hpp>

#include <set>
#include <string>

/// [[muscles]].
namespace gracilis::sections {

/// Settings that the scene's method does not have are named in `others`.
MuscleDescription read_muscle(TomlReader table, const MuscleDefaults& defaults, std::set<std::string>& others);

/// Adds a muscle with its surface, its line and given fibers, but without attachments. One that lists vertices of a
/// surface which had to be repaired is a problem.
void add_muscle(SceneInProgress& progress, SurfaceLoader& surfaces, const MuscleDescription& description);

}  // namespace gracilis::sections
