#pragma once

#include <gracilis/io/scene/scene_in_progress.hpp>
#include <gracilis/io/toml_reader.hpp>

/// [[transversals]].
namespace gracilis::sections {

/// One table; what is wrong with it goes to the reader's problems.
TransversalDescription read_transversal(TomlReader table);

/// Adds the transversals to the scene. Those that move a muscle which was left out are left out, too. Precondition: the
/// scene has its muscles and bones.
void add_transversals(SceneInProgress& progress);

}  // namespace gracilis::sections
