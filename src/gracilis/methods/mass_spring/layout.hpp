#pragma once

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/methods/mass_spring/settings.hpp>

#include <array>
#include <vector>

/// Which particles are joined by springs (Janák 2012, sections 2.3 and 4.4.2).
namespace gracilis::mass_spring {

/// Each once, the smaller number first, ascending.
using SpringPairs = std::vector<std::array<Index, 2>>;

/// Fibers as the rows of a lattice: rows[i][j] is a fiber's number. They are sorted across their mean direction, by
/// where their middles lie: into columns of nearly as many along the direction in which they spread most, and within a
/// column along the other. Fibers of muscles lie on no lattice, so this is this project's own.
std::vector<std::vector<Index>> fiber_lattice(const Polylines& particles);

/// Particles beside each other in the lattice of `fiber_lattice`, where the third number is that along the fiber: six
/// neighbors or, with diagonals, 26. At the lattice's border there are fewer.
SpringPairs cubic_pairs(const Polylines& particles, bool diagonals);

/// Each particle with its `count` nearest; it may be among the nearest of others, so some have more springs.
SpringPairs nearest_pairs(const Points& particles, Index count);

/// By the layout asked for. `particles` are those of each fiber, one line per fiber. Throws InputError where
/// tetrahedra are asked for and all particles lie in a plane.
SpringPairs spring_pairs(const Polylines& particles, SpringLayout layout, Index neighbors);

}  // namespace gracilis::mass_spring
