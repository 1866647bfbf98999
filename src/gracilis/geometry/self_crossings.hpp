#pragma once

#include <gracilis/geometry/topology.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/geometry/triangle_tree.hpp>

#include <vector>

namespace gracilis {

/// Which faces of a surface cross others: an edge of one runs through the inside of another with which it shares no
/// vertex. In single precision: what comes nearer than some 1e-7 of the surface's size may count, too. `triangles` and
/// `edges` are the mesh's. Precondition: at least one face, all coordinates finite.
std::vector<char> crossing_faces(const TriangleTree& triangles, const TriangleMesh& mesh,
                                 const std::vector<MeshEdge>& edges);

}  // namespace gracilis
