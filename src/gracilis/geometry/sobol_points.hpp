#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis {

/// Most numbers that a point of sobol_points has.
inline constexpr int most_sobol_dimensions = 21;

/// Points of Sobol's sequence (Sobol' 1967) with the direction numbers of Joe and Kuo (2008): a row per point, all
/// numbers in [0, 1). Every 2^k points in a row, counted from the first of the sequence, have one number in each 2^k-th
/// of any column's range. `skip` points are left out at the start. Requires 1 to most_sobol_dimensions columns and less
/// than 2^31 points.
Eigen::MatrixXd sobol_points(Eigen::Index count, int dimensions, Eigen::Index skip = 0);

}  // namespace gracilis
