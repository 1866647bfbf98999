#pragma once

#include "command.hpp"

#include <string>
#include <vector>

namespace gracilis {

/// gracilis compare SCENE --methods A,B,... --out DIR: one scene by several methods, side by side in one page.
/// `words` is the whole command line, for the manifests.
void add_compare_command(CLI::App& program, const std::vector<std::string>& words, Command& chosen);

}  // namespace gracilis
