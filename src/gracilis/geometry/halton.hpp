#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis {

/// The first `count` points of the Halton sequence (Halton 1960) in the unit cube of so many dimensions, a row each, in
/// the bases 2, 3, 5 ...: the digits of a point's number, from 1 on, mirrored at the point (Cervenka 2024, eq. 3.5).
/// Precondition: at most 16 columns.
Eigen::MatrixXd halton_points(Index count, Index columns);

}  // namespace gracilis
