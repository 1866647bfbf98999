#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// A coarser surface whose vertices are some of the given ones, so that it can follow them through all frames.
struct CoarseSurface {
  std::vector<Index> vertices;  ///< which of the given ones are left, in the coarse surface's order
  Eigen::Matrix3Xi faces;       ///< 3 × m, indices into `vertices`
};

/// At most about `vertex_count` vertices (Schroeder et al. 1992: vertices go where the surface is flattest, sharp edges
/// stay, the topology is kept). A surface that is small enough comes back as it is.
CoarseSurface decimate(const TriangleMesh& mesh, Index vertex_count);

/// Picks the vertices that are left.
Points picked(const Points& points, const std::vector<Index>& vertices);

}  // namespace gracilis
