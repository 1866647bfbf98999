#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis {

/// Moment arms about a coordinate from lengths along it (tendon excursion, An et al. 1984): \f$r = -dL/dq\f$, the
/// derivative of the parabola through three neighboring rows; at the first and last row that of the parabola there.
/// Positive where shortening increases the coordinate. `coordinate` in rad, ascending or descending, n; `lengths` n × m
/// in m; result n × m in m. With two rows the difference quotient; with one, zero.
Eigen::MatrixXd moment_arms(const Eigen::VectorXd& coordinate, const Eigen::MatrixXd& lengths);

/// The largest change from row to row over the change of the coordinate in degrees, m per degree: how smooth moment
/// arms are. 0 for less than two rows.
Real largest_step_per_degree(const Eigen::VectorXd& coordinate, const Eigen::VectorXd& arms);

}  // namespace gracilis
