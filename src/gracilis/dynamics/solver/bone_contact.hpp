#pragma once

#include <gracilis/dynamics/solver/surface_system.hpp>

#include <vector>

namespace gracilis {

/// Lists again what is near each obstacle.
void refresh_contacts(const SurfaceSystem& system, const std::vector<FieldPlacement>& placements, SurfaceState& state);

/// Before a substep moves obstacles or particles: on which side of each obstacle every particle is.
void remember_sides(const SurfaceSystem& system, const std::vector<FieldPlacement>& placements, SurfaceState& state);

/// Lists again what is near where something that is not listed may have come near.
void keep_listed(const SurfaceSystem& system, const std::vector<FieldPlacement>& placements, SurfaceState& state);

/// Finds the deepest points of the listed edges anew, against all obstacles.
void find_edge_points(const SurfaceSystem& system, const std::vector<FieldPlacement>& placements, SurfaceState& state);

/// Pushes what is listed out of all obstacles: edges, middles, faces, particles, and what is between two of them.
/// Returns how many were touching.
Index project_bone_contact(const SurfaceSystem& system, const std::vector<FieldPlacement>& placements,
                           SurfaceState& state);

}  // namespace gracilis
