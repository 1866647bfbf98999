#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/topology.hpp>

#include <vector>

namespace gracilis {

/// Length of the shortest way along edges from each vertex to the nearest of `sources`, m (Dijkstra 1959): never less
/// than the distance over the surface and, on even triangles, little more. Infinite where no way leads.
Eigen::VectorXd edge_distances(const Points& vertices, const MeshTopology& topology, const std::vector<Index>& sources);

}  // namespace gracilis
