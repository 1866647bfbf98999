#pragma once

#include <gracilis/geometry/mesh_pieces.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/prepare/time_limit.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// Drops closed pieces that lie in another one or on it: inner shells, and surfaces that are there twice. Returns how
/// many. The pieces must be closed and oriented outwards; they come back with the largest volume first.
Index drop_nested(std::vector<TriangleMesh>& pieces);

/// Whether pieces may be the heads of one muscle rather than scraps of it: each runs along at least half of the whole
/// and beside the largest, encloses a tenth of all, and lies in none of the others. The pieces must be closed and
/// oriented outwards, the largest first.
bool may_be_heads(const std::vector<TriangleMesh>& pieces);

/// What came of uniting surfaces.
struct United {
  std::vector<TriangleMesh> pieces;
  Index united = 0;   ///< surfaces that became part of another one
  bool exact = true;  ///< false: by winding numbers on a grid, where CGAL could not
};

/// Makes one piece of those that cut each other: the surface of what any of them encloses. Pieces that only touch stay
/// apart. The pieces must be closed and oriented outwards.
United united(std::vector<TriangleMesh> pieces, const TimeLimit& limit = TimeLimit());

}  // namespace gracilis
