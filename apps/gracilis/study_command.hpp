#pragma once

#include "command.hpp"

#include <string>
#include <vector>

namespace gracilis {

/// `gracilis study`: many runs that one file describes.
void add_study_command(CLI::App& program, const std::vector<std::string>& words, Command& chosen);

}  // namespace gracilis
