#pragma once

#include "command.hpp"

#include <gracilis/scene/scene.hpp>

#include <optional>
#include <string>
#include <vector>

namespace gracilis {

/// The built-in scene `name`, hip or elbow; its motion flexes from 0 to `flexion` (rad, at least 0) where it is given,
/// as far as the scene says otherwise.
Scene demo_scene(const std::string& name, std::optional<Real> flexion = {});

/// gracilis demo [SCENE]: the built-in hip or elbow through flexion; needs no file. `words` is the whole command line,
/// for the manifest.
void add_demo_command(CLI::App& program, const std::vector<std::string>& words, Command& chosen);

}  // namespace gracilis
