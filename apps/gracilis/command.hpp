#pragma once

#include <CLI/CLI.hpp>

#include <functional>

namespace gracilis {

/// What the command line asks for; returns the exit code. Each add_..._command describes its subcommand and puts the
/// function here once the user has chosen it.
using Command = std::function<int()>;

}  // namespace gracilis
