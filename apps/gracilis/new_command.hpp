#pragma once

#include "command.hpp"

namespace gracilis {

/// gracilis new FILES...: a commented scene of surfaces, which runs or says what is missing.
void add_new_command(CLI::App& program, Command& chosen);

}  // namespace gracilis
