#pragma once

#include "command.hpp"

namespace gracilis {

/// gracilis calibrate SCENE --targets TARGETS.toml: settings with which a scene comes nearest to what was measured.
void add_calibrate_command(CLI::App& program, Command& chosen);

}  // namespace gracilis
