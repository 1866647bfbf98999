#pragma once

#include <gracilis/core/types.hpp>

#include <cstdint>

namespace gracilis::opensim {

/// A Latin hypercube in the unit cube, a row for each point: each column has one point in the middle of every
/// `count`-th of its range (McKay, Beckman and Conover 1979), shuffled by the seed alike on every machine.
Eigen::MatrixXd latin_hypercube(Index count, Index columns, std::uint64_t seed);

/// The rows in the order in which each is followed by the nearest that is left, from the one nearest to `begin` on.
Eigen::MatrixXd nearest_next(const Eigen::MatrixXd& rows, const Eigen::RowVectorXd& begin);

}  // namespace gracilis::opensim
