#pragma once

#include "command.hpp"

#include <string>
#include <vector>

namespace gracilis {

/// gracilis transfer TEMPLATE --bones FOLDER --out FOLDER: a template's muscles and joints on a subject's bones.
void add_transfer_command(CLI::App& program, const std::vector<std::string>& words, Command& chosen);

}  // namespace gracilis
