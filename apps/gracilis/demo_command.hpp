#pragma once

#include "command.hpp"

#include <string>
#include <vector>

namespace gracilis {

/// gracilis demo [SCENE]: the built-in hip or elbow through flexion; needs no file. `words` is the whole command line,
/// for the manifest.
void add_demo_command(CLI::App& program, const std::vector<std::string>& words, Command& chosen);

}  // namespace gracilis
