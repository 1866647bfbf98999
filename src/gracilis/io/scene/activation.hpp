#pragma once

#include <gracilis/io/scene/scene_in_progress.hpp>
#include <gracilis/io/toml_reader.hpp>

/// [[activations]].
namespace gracilis::sections {

/// One table; what is wrong with it goes to the reader's problems.
ActivationDescription read_activation(TomlReader table);

/// Adds what drives the described muscles to the scene's plan. Precondition: the scene has its joints.
void add_activation(SceneInProgress& progress, const ActivationDescription& description);

}  // namespace gracilis::sections
