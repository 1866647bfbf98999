#pragma once

#include <gracilis/simulate/arm_comparison.hpp>

#include <filesystem>
#include <vector>

namespace gracilis {

/// Reads published moment arms, a .csv whose first line names its columns, in any order: `muscle`, `angle_deg`, and the
/// arm, -dL/dq, as `moment_arm_mm`, `moment_arm_cm`, `moment_arm_m` or `mean` (m). It may also have `coordinate`, the
/// source (`source` or `model`: each is a curve of its own), and `min` and `max` in the arm's unit. Rows of one muscle,
/// coordinate and source may come in any order, each angle once; without a source the file's name is it. Curves come in
/// order of first appearance; other columns and blank lines are skipped. Throws InputError with file and line: missing
/// columns, cells that are not finite numbers, an angle twice, no rows.
std::vector<ArmCurve> read_arm_reference(const std::filesystem::path& path);

}  // namespace gracilis
