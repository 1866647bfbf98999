#pragma once

#include <gracilis/calibrate/calibration.hpp>

namespace gracilis {

/// Reads what to aim at and what to change (docs/guide/calibration.md), and the files that it names, which lie beside
/// it or in `data` (empty: GRACILIS_DATA, or shared/data above it). Throws ConfigurationError, or InputError where a
/// file is at fault, with every problem found.
Calibration read_targets(const std::filesystem::path& file, const std::filesystem::path& data = {});

}  // namespace gracilis
