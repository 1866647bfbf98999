#pragma once

#include "command.hpp"

namespace gracilis {

/// gracilis view: a window onto a recorded run, or onto a scene that moves as one pulls its sliders.
void add_view_command(CLI::App& program, Command& chosen);

}  // namespace gracilis
