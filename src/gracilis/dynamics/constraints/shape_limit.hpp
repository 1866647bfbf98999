#pragma once

#include <gracilis/dynamics/particles.hpp>
#include <gracilis/geometry/surface_shape.hpp>

#include <vector>

namespace gracilis {

/// How far a place of a surface may depart from its shape at rest; 0: as far as it likes.
struct ShapeLimits {
  float spike = 0;      ///< that a vertex stands out from its neighbors, beyond rest, over the length of its edges
  float thickness = 0;  ///< distance to the vertex that it faces through the surface, over that at rest
  float thinness = 0;   ///< that at rest over it

  bool any() const { return spike > 0 || thickness > 0 || thinness > 0; }  ///< whether anything is limited
};

/// A SurfaceShape at rest, per particle, in single precision. Lengths in m.
struct ShapeLimitSet {
  VertexStars stars;
  std::vector<Index> opposite;
  std::vector<float> apart, reach, thickness;
  float mean_edge = 0;
};

/// Of a surface at rest; the numbers of vertices are those of particles.
ShapeLimitSet build_shape_limits(const SurfaceShape& rest);

/// The particles that are beyond `share` of a limit or of the way to it, in ascending order.
std::vector<Index> near_shape_limits(const ShapeLimitSet& set, const ShapeLimits& limits, float share,
                                     const Particles& particles);

/// Brings `listed` particles back to the limits, one after the other, without compliance and without a multiplier:
/// \f$C = s \rho + a - |x - \bar x| \ge 0\f$ moves a particle and its neighbors, whose mean is x̄ (s the spike limit, ρ
/// the reach, a apart), \f$C = t (r + \bar e) - \bar e - |x - x_o| \ge 0\f$ the two that face each other (t limits
/// thickness, r the distance at rest, ē the mean edge), and so does \f$C = |x - x_o| + \bar e - (r + \bar e) / n \ge
/// 0\f$ (n limits thinness). Returns how many were beyond one.
Index project_shape_limits(const ShapeLimitSet& set, const ShapeLimits& limits, const std::vector<Index>& listed,
                           Particles& particles);

}  // namespace gracilis
