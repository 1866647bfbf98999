#pragma once

#include "command.hpp"

#include <string>
#include <vector>

namespace gracilis {

/// gracilis run SCENE.toml: through the whole motion of a scene file, into a run folder. `words` is the whole
/// command line, for the manifest.
void add_run_command(CLI::App& program, const std::vector<std::string>& words, Command& chosen);

}  // namespace gracilis
