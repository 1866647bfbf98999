#pragma once

#include "command.hpp"

namespace gracilis {

/// gracilis motions MODEL: sample motions that fill the space of a joint's angles.
void add_motions_command(CLI::App& program, Command& chosen);

}  // namespace gracilis
