#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/topology.hpp>

#include <vector>

namespace gracilis {

/// Ways along the edges of a surface, each edge at a cost that is not negative (its length, for example).
struct EdgeGraph {
  VertexStars stars;
  std::vector<Real> costs;  ///< beside stars.neighbors
};

/// The graph whose costs are the edges' lengths, m.
EdgeGraph length_graph(const Points& vertices, const MeshTopology& topology);

/// The vertices of a cheapest way from one vertex to another, both included (Dijkstra 1959); of several equally cheap
/// ones always the same. Empty when there is none. Against the exact geodesic the length along edges is too large by up
/// to 2/√3 - 1 = 15.5 % on regular triangles, more on slanted ones.
std::vector<Index> shortest_path(const EdgeGraph& graph, Index from, Index to);

/// Cost of the cheapest way from the nearest of `sources` to each vertex; along lengths it is never less than the
/// distance over the surface. Infinite where no way leads.
Eigen::VectorXd edge_distances(const EdgeGraph& graph, const std::vector<Index>& sources);

/// Sum of the costs along a way.
Real path_cost(const EdgeGraph& graph, const std::vector<Index>& path);

}  // namespace gracilis
