#pragma once

#include <gracilis/geometry/topology.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

namespace gracilis {

/// Where a muscle's vertices are drawn: what goes up and down from vertex to vertex is smoothed out, which leaves rims
/// on bones without notches. Up to half the mean length of the edges at rest, so that what is torn out of a surface is
/// still seen.
class EvenedSurface {
 public:
  /// A surface at rest, m.
  explicit EvenedSurface(const TriangleMesh& rest);

  /// One place per vertex, m. Precondition: as many vertices as at rest.
  Points of(const Points& vertices) const;

 private:
  VertexStars stars_;
  Real farthest_ = 0;  ///< m
};

}  // namespace gracilis
