#pragma once

#include <gracilis/geometry/topology.hpp>

#include <vector>

namespace gracilis {

/// How many clusters (ColorOrder) so many particles make; cluster i of n has the numbers from i/n to (i + 1)/n of all.
Index cluster_count_of(Index particle_count);

/// The first particle of a cluster; of cluster `cluster_count`, the end of all.
Index begin_of_cluster(Index cluster, Index particle_count, Index cluster_count);

/// The cluster of a particle.
Index cluster_of(Index particle, Index particle_count, Index cluster_count);

/// In which order the vertices of a surface become particles: order[new] = old. Neighbors on the surface are neighbors
/// in memory, breadth-first. A large surface is cut into its clusters first, by halving along the longest axis: a
/// cluster would otherwise be a band a few vertices wide, and nearly all constraints lie across two.
std::vector<Index> particle_order(const Points& vertices, const VertexStars& stars);

}  // namespace gracilis
