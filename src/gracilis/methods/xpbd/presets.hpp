#pragma once

#include <gracilis/scene/presets.hpp>

#include <vector>

namespace gracilis {

/// `physical`, the default: real masses and units. `thesis-2024`: the published setting of the method, with everything
/// that this project added switched off; it is there to compare with and does break. `fast`: coarser copies of the
/// muscles are simulated, and the surfaces follow them.
std::vector<Preset> xpbd_presets();

}  // namespace gracilis
