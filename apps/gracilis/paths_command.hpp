#pragma once

#include "command.hpp"

namespace gracilis {

/// gracilis paths MODEL: lengths and moment arms of an OpenSim model's muscles, as OpenSim's tables.
void add_paths_command(CLI::App& program, Command& chosen);

}  // namespace gracilis
