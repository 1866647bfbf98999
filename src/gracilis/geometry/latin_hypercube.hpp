#pragma once

#include <gracilis/core/types.hpp>

#include <cstdint>
#include <random>
#include <vector>

namespace gracilis {

/// 0 ... count - 1 in an order that the generator chooses alike on every machine, which std::shuffle does not.
std::vector<Index> shuffled_order(Index count, std::mt19937_64& random);

/// A Latin hypercube in the unit cube, a row for each point: each column has one point in the middle of every
/// `count`-th of its range (McKay, Beckman and Conover 1979), shuffled by the seed alike on every machine.
Eigen::MatrixXd latin_hypercube(Index count, Index columns, std::uint64_t seed);

}  // namespace gracilis
