#pragma once

#include <gracilis/core/types.hpp>

#include <array>
#include <vector>

namespace gracilis {

/// The edges of the Delaunay tetrahedra of points in space (by Qhull: Barber, Dobkin and Huhdanpaa 1996), each once,
/// the smaller number first, ascending. Of points that coincide only one has edges. Throws InputError where there are
/// fewer than four points, all lie in a plane, or a coordinate is not finite.
std::vector<std::array<Index, 2>> delaunay_edges(const Points& points);

}  // namespace gracilis
