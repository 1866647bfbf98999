#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

namespace gracilis {

/// Takes sheets apart that meet in an edge or a vertex: around an edge with more than two faces those become neighbors
/// that have a solid between them, as in cutting and stitching (Guéziec, Taubin, Lazarus and Horn 2001), and every fan
/// of faces has a vertex of its own. A closed surface stays closed. Vertices of one piece that came apart are drawn a
/// twentieth of the way to their neighbors, so that its sheets do not touch. What has no partner around an edge stays
/// open there. Precondition: no face names a vertex twice, faces of a patch agree.
TriangleMesh separate_sheets(const TriangleMesh& mesh);

}  // namespace gracilis
