#pragma once

#include <gracilis/geometry/topology.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// The topology of a muscle whose closed pieces hang together: a piece that is not attached to every body that any is
/// attached to gets edges to the nearest other piece, between vertices that are about as near as the nearest two, so
/// that it follows what it lies on. Such edges have no faces. `fixed_body` has a body or -1 per vertex. Of a surface in
/// one piece, and of pieces that are attached everywhere, the topology itself.
MeshTopology joined_pieces(const TriangleMesh& surface, const MeshTopology& topology,
                           const std::vector<Index>& fixed_body);

}  // namespace gracilis
