#pragma once

#include "command.hpp"

#include <string>
#include <vector>

namespace gracilis {

/// gracilis rom SCENE --coord NAME=FROM:TO:STEP: through a range of motion of one coordinate, with moment arms. `words`
/// is the whole command line, for the manifest.
void add_rom_command(CLI::App& program, const std::vector<std::string>& words, Command& chosen);

}  // namespace gracilis
