#pragma once

#include <gracilis/geometry/topology.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// Skinning weights: which share of each body's motion every vertex of a muscle follows. Harmonic fields, 1 on a body's
/// own attachments and 0 on the others'. Pieces that lack attachments follow those they lie on (joined_pieces). Within
/// `tendon_length` (m, along the surface) of attachments the surface is graded from belly to tendon: where the weights
/// would change fastest, it conducts better, so that motion goes to the belly instead of gathering in the triangles
/// beside an attachment. 0 grades nothing. `fixed_body` has a body or -1 per vertex. Result: bodies × vertices, not
/// negative; columns sum to 1, or are 0 where no attachment can be reached.
Eigen::MatrixXf skinning_weights(const TriangleMesh& surface, const MeshTopology& topology,
                                 const std::vector<Index>& fixed_body, const std::vector<Index>& bodies,
                                 Real tendon_length);

}  // namespace gracilis
