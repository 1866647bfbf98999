#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis::opensim {

/// The rows in the order in which each is followed by the nearest that is left, from the one nearest to `begin` on.
Eigen::MatrixXd nearest_next(const Eigen::MatrixXd& rows, const Eigen::RowVectorXd& begin);

}  // namespace gracilis::opensim
