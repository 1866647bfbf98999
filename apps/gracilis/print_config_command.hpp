#pragma once

#include "command.hpp"

namespace gracilis {

/// gracilis print-config: a complete commented scene file to stdout.
void add_print_config_command(CLI::App& program, Command& chosen);

}  // namespace gracilis
