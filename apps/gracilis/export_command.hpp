#pragma once

#include "command.hpp"

namespace gracilis {

/// gracilis export: what a run holds, in other programs' formats.
void add_export_command(CLI::App& program, Command& chosen);

}  // namespace gracilis
