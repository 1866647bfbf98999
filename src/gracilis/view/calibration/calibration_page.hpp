#pragma once

#include <gracilis/calibrate/run_calibration.hpp>

#include <filesystem>
#include <string>

namespace gracilis {

/// Writes what a calibration found as one page without scripts: parameters with errors, targets before and after, the
/// history. `use`: command lines that run the scene with the values found. Throws InputError.
void write_calibration_page(const std::filesystem::path& path, const CalibrationResult& result, const std::string& use);

}  // namespace gracilis
