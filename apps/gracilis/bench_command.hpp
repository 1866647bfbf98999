#pragma once

#include "command.hpp"

#include <CLI/CLI.hpp>

namespace gracilis {

/// `gracilis bench [SCENE]`: times the solver on a scene, or on the built-in hip.
void add_bench_command(CLI::App& program, Command& chosen);

}  // namespace gracilis
