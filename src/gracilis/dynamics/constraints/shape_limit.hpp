#pragma once

#include <gracilis/dynamics/particles.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <vector>

namespace gracilis {

/// How far a place of a surface may depart from its shape at rest; 0: as far as it likes.
struct ShapeLimits {
  float spike = 0;      ///< that a vertex stands out from its neighbors, beyond rest, over the length of its edges
  float thickness = 0;  ///< distance to the vertex that it faces through the surface, over that at rest

  bool any() const { return spike > 0 || thickness > 0; }
};

/// What the limits are measured by, per particle. Lengths in m.
struct ShapeLimitSet {
  std::vector<Index> offsets, neighbors;  ///< of particle p: neighbors[offsets[p]] up to neighbors[offsets[p + 1]]
  std::vector<float> apart;               ///< distance from the mean of its neighbors at rest
  std::vector<float> reach;               ///< mean edge around it at rest, at least half of the surface's mean
  std::vector<Index> opposite;            ///< the particle it faces through the surface, -1: none
  std::vector<float> thickness;           ///< distance to that at rest
  float mean_edge = 0;                    ///< of the surface: what is thinner is not resolved
};

/// Precondition: at least one face, all coordinates finite.
ShapeLimitSet build_shape_limits(const TriangleMesh& rest);

/// The particles that are beyond `share` of a limit or of the way to it, in ascending order.
std::vector<Index> near_shape_limits(const ShapeLimitSet& set, const ShapeLimits& limits, float share,
                                     const Particles& particles);

/// Brings `listed` particles back to the limits, one after the other, without compliance and without a multiplier:
/// C = spike · reach + apart - |x - mean of neighbors| >= 0 moves a particle and its neighbors,
/// C = thickness · (rest + mean edge) - mean edge - |x - x_opposite| >= 0 the two that face each other. Returns how
/// many were beyond one.
Index project_shape_limits(const ShapeLimitSet& set, const ShapeLimits& limits, const std::vector<Index>& listed,
                           Particles& particles);

}  // namespace gracilis
