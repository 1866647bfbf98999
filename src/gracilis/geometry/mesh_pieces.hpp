#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// The connected pieces of a surface, largest area first; vertices that no face names are left out. Indices must be in
/// range.
std::vector<TriangleMesh> pieces_of(const TriangleMesh& mesh);

/// All surfaces in one mesh, one after the other.
TriangleMesh merged(const std::vector<TriangleMesh>& meshes);

/// The piece that encloses most, whichever way it is turned; of a surface in one piece itself, as it is.
TriangleMesh largest_piece(const TriangleMesh& mesh);

}  // namespace gracilis
