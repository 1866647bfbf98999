#pragma once

#include "command.hpp"

namespace gracilis {

/// gracilis static-optimization SETUP.xml: activations of muscles that give a measured motion.
void add_static_optimization_command(CLI::App& program, Command& chosen);

}  // namespace gracilis
