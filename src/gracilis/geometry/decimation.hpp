#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

#include <span>
#include <vector>

namespace gracilis {

/// A coarser surface whose vertices are some of the given ones, so that it can follow them through all frames.
struct CoarseSurface {
  std::vector<Index> vertices;  ///< which of the given ones are left, in the coarse surface's order
  Eigen::Matrix3Xi faces;       ///< 3 × m, indices into `vertices`
  std::vector<Index> went_to;   ///< per given vertex: the one of `vertices` that it is or was drawn onto
};

/// At most about `vertex_count` vertices: the edge whose collapse onto one of its ends costs least goes first, where
/// the cost is the squared distance to the planes that meet there (Garland and Heckbert 1997) and, a thousand times
/// weaker, the edge's squared length, so that flat parts get triangles of one size. The topology is kept: a closed
/// surface stays closed, an open border stays where it is, no triangle turns over. Where no edge can go any more, more
/// vertices stay. An edge whose ends have different `labels` (one per vertex, or none at all) stays, so that every
/// labelled region keeps a vertex and its outline. A surface that is small enough comes back as it is.
CoarseSurface decimate(const TriangleMesh& mesh, Index vertex_count, std::span<const Index> labels = {});

/// Picks the vertices that are left.
Points picked(const Points& points, const std::vector<Index>& vertices);

}  // namespace gracilis
