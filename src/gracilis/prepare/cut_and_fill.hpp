#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/prepare/time_limit.hpp>

namespace gracilis {

/// Cuts out the triangles that cut each other, with their surroundings, and fills the holes; more around them each
/// time, in at most five rounds. True where the surface is closed and nothing of it cuts itself any more; otherwise it
/// is as far as that went. Pieces that the cuts set free go, except those with `crumb_share` of the area. The surface
/// must be closed and manifold.
bool cut_and_fill(TriangleMesh& mesh, Real crumb_share, const TimeLimit& limit);

}  // namespace gracilis
