#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/prepare/time_limit.hpp>

namespace gracilis {

/// Where a mesh of a surface cuts itself its vertices go back onto that surface and its triangles are divided, some
/// rounds long: chords that cross each other, as across the gap between two folds, come apart once they are short
/// enough. Tells whether nothing cuts in the end; otherwise the mesh is of no use. Precondition: the mesh is closed,
/// and the surface does not cut itself.
bool follow_where_cut(TriangleMesh& mesh, const TriangleMesh& surface, const TimeLimit& limit = TimeLimit());

}  // namespace gracilis
