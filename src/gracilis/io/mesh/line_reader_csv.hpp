#pragma once

#include <gracilis/geometry/polylines.hpp>

#include <filesystem>

namespace gracilis {

/// Reads lines from a table: the columns `tract` (or `line`), whose rows of the same name, one after the other, are a
/// line, and `x_mm`, `y_mm`, `z_mm`, or `x`, `y`, `z` in the file's unit, whose length is `unit` m. Throws InputError
/// with the line of the file.
Polylines read_csv_lines(const std::filesystem::path& path, Real unit);

}  // namespace gracilis
