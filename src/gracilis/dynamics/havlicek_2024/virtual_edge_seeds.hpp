#pragma once

#include <gracilis/dynamics/havlicek_2024/virtual_edges.hpp>

#include <vector>

namespace gracilis {

/// A state that is seeded at its first frame.
VirtualEdgeState make_virtual_edge_state(const VirtualEdgeWorld& world);

/// At the beginning of a frame, before the prediction: seeds all edges where the period is over. From each particle of
/// a pair's first surface an edge goes to the nearest particle of the second, where it is within reach.
void begin_edge_frame(const VirtualEdgeWorld& world, const std::vector<const Particles*>& particles,
                      VirtualEdgeState& state);

/// At the end of a frame: counts the edges that coincide with one before them, and drops or re-seeds these as the
/// settings say.
void end_edge_frame(const VirtualEdgeWorld& world, VirtualEdgeState& state);

}  // namespace gracilis
