#pragma once

#include <gracilis/dynamics/constraints/distance.hpp>
#include <gracilis/dynamics/contact/field/near_field.hpp>
#include <gracilis/dynamics/particles.hpp>

namespace gracilis {

/// Of an edge that was this far above its gap at its deepest point, other points were, too, m.
inline constexpr float edge_reserve = 0.0005f;

/// Finds the deepest points of all edges whose `seen_above` is within the reserve. Vectorised for the machine it runs
/// on, like the next.
void find_deepest_points(const FieldGrid& grid, const FieldPlacement& placement, const Particles& particles,
                         NearEdges& edges);

/// Pushes the deepest points of the edges in `range`, which belong to one color, out along the field's gradient, and
/// follows those points by at most `longest_step` (m). Returns how many were pushed.
Index project_near_edges(const FieldGrid& grid, const FieldPlacement& placement, float longest_step, ColorRange range,
                         NearEdges& edges, Particles& particles);

/// Appends the slots of a color of which the clearances at both ends together are at most `reach` and `per_length`
/// times the length at rest; by rounding some more.
void gather_low_edges(const DistanceSet& distances, ColorRange color, const std::vector<float>& clearance, float reach,
                      float per_length, std::vector<Index>& slots);

}  // namespace gracilis
