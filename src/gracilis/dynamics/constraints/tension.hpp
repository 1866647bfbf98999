#pragma once

#include <gracilis/dynamics/constraints/distance.hpp>

namespace gracilis {

/// How the segments of an active surface act.
struct TensionLaw {
  float strength = 0;      ///< factor on stiffness and dissipation; 0: they do not act
  bool two_sided = false;  ///< they hold the length aimed at both ways (Havlíček 2024) instead of pulling only
};

/// Projects tensions of slots [begin, end), which belong to one color: distance constraints that only pull,
/// \f$C = L - |x_b - x_a| \ge 0\f$, L the target, or C = 0 where the law is two-sided. One that only pulls and is under
/// its target is left alone, except that it gives back what it was pulled too far within this substep. Precondition:
/// strength > 0; the rest as for project_distances.
ProjectionCounts project_tensions(const DistanceSet& set, ColorRange range, const float* target_length,
                                  const TensionLaw& law, float* lambda, const Particles& start, Particles& particles,
                                  const ProjectionParameters& parameters);

}  // namespace gracilis
