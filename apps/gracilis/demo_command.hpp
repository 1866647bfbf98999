#pragma once

#include "command.hpp"

#include <gracilis/io/scene/demo_scene.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// What `demo` asks of its scene: SCENE and all that changes it. Both must outlive the command.
void add_demo_options(CLI::App& command, DemoOptions& demo, SceneOptions& changes);

/// gracilis demo [SCENE]: the built-in hip or elbow through flexion; needs no file. `words` is the whole command line,
/// for the manifest.
void add_demo_command(CLI::App& program, const std::vector<std::string>& words, Command& chosen);

}  // namespace gracilis
