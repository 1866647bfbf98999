#pragma once

#include <gracilis/core/types.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// Landmarks that belong together, such as the outline of an attachment, in the order of the file's rows.
struct LandmarkCloud {
  std::string name;
  Points points;                    ///< 3 × n, m
  std::vector<std::string> labels;  ///< what the column `index` says of each; empty texts without that column
};

/// Reads a .csv with columns cloud, x, y, z and perhaps index, in any order. The coordinates' unit stands in their
/// columns' names (x_mm, x_cm or x_m); without it, `unit` is its length in m. Clouds come in order of first appearance;
/// blank lines are skipped. Throws InputError with file and line: missing columns, units that differ, rows without a
/// name or with cells that are not finite numbers, no rows.
std::vector<LandmarkCloud> read_landmarks(const std::filesystem::path& path, Real unit);

}  // namespace gracilis
