#pragma once

#include <gracilis/simulate/arm_comparison.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// Reads moment arms over a coordinate, as somebody published or computed them.
///
/// A .csv: its first line names its columns, in any order: `muscle`, `angle_deg`, and the arm, -dL/dq, as
/// `moment_arm_mm`, `moment_arm_cm`, `moment_arm_m` or `mean` (m). It may also have `coordinate`, the source (`source`
/// or `model`: each is a curve of its own), and `min` and `max` in the arm's unit. Rows of one muscle, coordinate and
/// source may come in any order, each angle once; without a source the file's name is it. Curves come in order of first
/// appearance; other columns and blank lines are skipped.
///
/// A .sto or .mot, such as `gracilis rom` writes: the column `coordinate` has the angles, every other one is a curve
/// of that name, in m. Where angles come again, as on the way to a range, their last row counts.
///
/// Throws InputError with file and line: missing columns, cells that are not finite numbers, an angle twice, no rows.
std::vector<ArmCurve> read_arm_reference(const std::filesystem::path& path, const std::string& coordinate = "");

/// The same of lengths: `length_mm`, `length_cm`, `length_m` or `mean` (m); they stand in ArmCurve::arms, m.
std::vector<ArmCurve> read_length_reference(const std::filesystem::path& path, const std::string& coordinate);

}  // namespace gracilis
