#pragma once

#include <gracilis/anatomy/fibers/nearest_fiber.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/scene/scene.hpp>

#include <vector>

namespace gracilis::xpbd {

/// Fiber direction on each triangle, unit: the gradient of the harmonic coordinate that is 0 on origins and 1 on
/// insertions (3 × faces; zero where there is none).
Points fiber_directions(const Points& vertices, const Eigen::Matrix3Xi& faces, const MeshTopology& topology,
                        const std::vector<Attachment>& attachments);

/// Fiber direction at each edge's middle, unit (3 × edges; zero where there is none): that of the nearest fiber, or,
/// where there are no fibers, the mean of `fiber_directions` on the edge's two triangles.
Points edge_fiber_directions(const TriangleMesh& surface, const MeshTopology& topology,
                             const std::vector<Attachment>& attachments, const NearestFiber& fibers);

}  // namespace gracilis::xpbd
