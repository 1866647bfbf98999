#pragma once

#include <CLI/CLI.hpp>

#include <functional>

namespace gracilis {

/// gracilis inspect FILE...: what is in a mesh, table, landmark file, model, scene or run folder. Puts the function to
/// run, which returns the exit code, into `chosen`.
void add_inspect_command(CLI::App& program, std::function<int()>& chosen);

}  // namespace gracilis
