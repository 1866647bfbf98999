#pragma once

#include "command.hpp"

namespace gracilis {

/// gracilis import MODEL.osim: a scene of bones, joints and volumetric muscles.
void add_import_command(CLI::App& program, Command& chosen);

}  // namespace gracilis
