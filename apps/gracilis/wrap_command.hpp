#pragma once

#include "command.hpp"

namespace gracilis {

void add_wrap_command(CLI::App& program, Command& chosen);

}  // namespace gracilis
