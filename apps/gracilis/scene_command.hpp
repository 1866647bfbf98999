#pragma once

#include "command.hpp"

namespace gracilis {

/// `gracilis scene`: a scene file from a folder of surfaces.
void add_scene_command(CLI::App& program, Command& chosen);

}  // namespace gracilis
