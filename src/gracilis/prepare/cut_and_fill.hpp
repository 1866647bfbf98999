#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/prepare/time_limit.hpp>

#include <vector>

namespace gracilis {

/// For every face whether it cuts another one of the mesh.
std::vector<char> faces_that_cut(const TriangleMesh& mesh, const TimeLimit& limit);

/// Also chooses the faces that share a vertex with a chosen one.
void widen(const TriangleMesh& mesh, std::vector<char>& chosen);

/// Cuts out the triangles that cut each other, with their surroundings, and fills the holes; more around them each
/// time, in at most five rounds. True where the surface is closed and nothing of it cuts itself any more; otherwise it
/// is as far as that went. Pieces that the cuts set free go, except those with `crumb_share` of the area. The surface
/// must be closed and manifold.
bool cut_and_fill(TriangleMesh& mesh, Real crumb_share, const TimeLimit& limit);

/// The same, with some faces (one mark per face) cut out besides, the first time.
bool cut_and_fill(TriangleMesh& mesh, const std::vector<char>& chosen, Real crumb_share, const TimeLimit& limit);

}  // namespace gracilis
