#pragma once

#include "command.hpp"

namespace gracilis {

/// gracilis activations neighbors SAMPLES POSES --out FOLDER: which samples of a joint control unit are asked.
void add_neighbors_command(CLI::App& activations, Command& chosen);

}  // namespace gracilis
