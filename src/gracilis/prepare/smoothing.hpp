#pragma once

#include <gracilis/geometry/triangle_mesh.hpp>

namespace gracilis {

/// Smooths the whole surface, as smooth_points does.
void smooth_surface(TriangleMesh& mesh, int rounds);

/// The same for spikes and sharp rims alone: around edges at which the surface turns by more than `sharp` (rad), fading
/// out over two rings of vertices, until there are none or `rounds` are over. No vertex moves further than `farthest`
/// (m) in all. Returns the number of edges that are still as sharp.
Index round_off(TriangleMesh& mesh, Real sharp, int rounds, Real farthest);

/// Edges at which the surface turns by more than `sharp` (rad). Open edges do not count.
Index sharp_edge_count(const TriangleMesh& mesh, Real sharp);

}  // namespace gracilis
