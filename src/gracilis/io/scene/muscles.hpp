#pragma once

#include <gracilis/io/scene/scene_in_progress.hpp>
#include <gracilis/io/scene/surfaces.hpp>
#include <gracilis/io/toml_reader.hpp>
#include <gracilis/methods/method_entry.hpp>

#include <set>
#include <string>

/// [[muscles]] and their tables, without the attachments.
namespace gracilis::sections {

/// What holds for muscles that say nothing else.
struct MuscleDefaults {
  FiberSettings fibers;
  ContractionSettings contraction;
};

/// Names the settings of other methods than the scene's in `others`.
MuscleDescription read_muscle(TomlReader table, const MethodEntry& method, const MuscleDefaults& defaults,
                              std::set<std::string>& others);

/// Adds a muscle with its surface, its line and given fibers, but without attachments. One that lists vertices of a
/// surface which had to be repaired is a problem.
void add_muscle(SceneInProgress& progress, SurfaceLoader& surfaces, const MuscleDescription& description);

}  // namespace gracilis::sections
