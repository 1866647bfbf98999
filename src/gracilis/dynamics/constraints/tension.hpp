#pragma once

#include <gracilis/dynamics/constraints/distance.hpp>

namespace gracilis {

/// Projects tensions of slots [begin, end), which belong to one color: distance constraints that only pull, C =
/// target_length - |x_b - x_a| >= 0. A segment that is shorter than its target is left alone, except that it gives back
/// what it was pulled too far within this substep. `strength` > 0 is a factor on the stiffness; the rest as for
/// project_distances.
ProjectionCounts project_tensions(const DistanceSet& set, ColorRange range, const float* target_length, float strength,
                                  float* lambda, Particles& particles, const ProjectionParameters& parameters);

}  // namespace gracilis
