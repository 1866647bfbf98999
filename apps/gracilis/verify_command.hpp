#pragma once

#include "command.hpp"

namespace gracilis {

/// `gracilis verify RUN`
void add_verify_command(CLI::App& program, Command& chosen);

}  // namespace gracilis
