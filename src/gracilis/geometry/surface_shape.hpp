#pragma once

#include <gracilis/geometry/topology.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// What spikes and thickness of a surface are measured by: how each of its vertices lies beside its neighbors and
/// beside the vertex that it faces through the body inside. Lengths in m.
struct SurfaceShape {
  VertexStars stars;
  std::vector<Index> opposite;  ///< the vertex that each one faces, -1: none
  std::vector<Real> apart;      ///< from the mean of its neighbors, 0 without any
  std::vector<Real> reach;      ///< mean edge around it, at least half of the surface's mean
  std::vector<Real> thickness;  ///< to the vertex that it faces, 0 without one
  Real mean_edge = 0;           ///< of the surface: what is thinner is not resolved
};

/// Precondition: at least one face, all coordinates finite, `topology` is the surface's.
SurfaceShape shape_of(const TriangleMesh& surface, const MeshTopology& topology);

/// From the mean of a vertex's neighbors to the vertex; zero without any.
Vec3 from_neighbors(const VertexStars& stars, Index vertex, const Points& points);

}  // namespace gracilis
