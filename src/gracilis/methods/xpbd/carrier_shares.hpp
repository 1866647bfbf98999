#pragma once

#include <gracilis/geometry/topology.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis::xpbd {

/// Which share of each body's motion every vertex follows before the solver relaxes: harmonic fields, 1 on a body's own
/// attachments and 0 on the others'. Within `tendon_length` (m, along the surface) of attachments the surface is graded
/// from belly to tendon: where the shares would change fastest, it conducts better, so that motion goes to the belly
/// instead of gathering in the triangles beside an attachment. 0 grades nothing. `fixed_body` has a body or -1 per
/// vertex. Result: carriers × vertices, not negative; columns sum to 1, or are 0 where no attachment can be reached.
Eigen::MatrixXf carrier_shares(const TriangleMesh& surface, const MeshTopology& topology,
                               const std::vector<Index>& fixed_body, const std::vector<Index>& carriers,
                               Real tendon_length);

}  // namespace gracilis::xpbd
