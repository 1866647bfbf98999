#pragma once

#include "command.hpp"

namespace gracilis {

/// gracilis fibers SCENE: the fibers of all muscles in the capture pose, as .vtp, table and pictures.
void add_fibers_command(CLI::App& program, Command& chosen);

}  // namespace gracilis
