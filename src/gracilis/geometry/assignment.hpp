#pragma once

#include <gracilis/core/types.hpp>

#include <vector>

namespace gracilis {

/// The one-to-one assignment of rows to columns of a square matrix with the least sum of costs: result[row] = column.
/// Shortest augmenting paths with potentials (Jonker and Volgenant 1987), O(n³): 1000 rows take about a second.
/// Precondition: finite costs.
std::vector<Index> cheapest_assignment(const Eigen::MatrixXd& costs);

}  // namespace gracilis
