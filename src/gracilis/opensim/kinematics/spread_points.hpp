#pragma once

#include <gracilis/core/types.hpp>

#include <cstdint>

namespace gracilis::opensim {

/// Points that fill the unit cube, a row each.

/// The first `count` of Halton's sequence after the origin, with the primes from 2 on as bases (Halton 1960). Up to 16
/// columns.
Eigen::MatrixXd halton_points(Index count, Index columns);

/// A Latin hypercube: each column has one point in the middle of every `count`-th of its range (McKay, Beckman and
/// Conover 1979), shuffled by the seed alike on every machine.
Eigen::MatrixXd latin_hypercube(Index count, Index columns, std::uint64_t seed);

/// The rows in the order in which each is followed by the nearest that is left, from the one nearest to `begin` on.
Eigen::MatrixXd nearest_next(const Eigen::MatrixXd& rows, const Eigen::RowVectorXd& begin);

}  // namespace gracilis::opensim
