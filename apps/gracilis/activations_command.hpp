#pragma once

#include "command.hpp"

namespace gracilis {

/// gracilis activations join MOTIONS RESULTS --out samples.sto: samples for joint control units.
void add_activations_command(CLI::App& program, Command& chosen);

}  // namespace gracilis
