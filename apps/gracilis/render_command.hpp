#pragma once

#include "command.hpp"

namespace gracilis {

/// gracilis render: pictures and films of runs, without a display.
void add_render_command(CLI::App& program, Command& chosen);

}  // namespace gracilis
