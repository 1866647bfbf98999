#pragma once

#include "command.hpp"

namespace gracilis {

/// gracilis report: one HTML file that shows and explains one or several runs.
void add_report_command(CLI::App& program, Command& chosen);

}  // namespace gracilis
