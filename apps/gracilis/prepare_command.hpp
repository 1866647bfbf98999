#pragma once

#include "command.hpp"

namespace gracilis {

/// gracilis prepare FILE...|SCENE.toml: repaired, remeshed surfaces without overlaps. Built without the component, the
/// command says so and ends with exit code 2.
void add_prepare_command(CLI::App& program, Command& chosen);

}  // namespace gracilis
