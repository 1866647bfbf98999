#pragma once

#include <gracilis/strings/node_forces.hpp>

#include <vector>

namespace gracilis::strings {

/// Gauss-Newton steps for all strings of a muscle, in double precision and one string after the other: to pull fibers
/// tight, and what `relax_lanes` is judged by. Returns how far a node of each string moved last, m.
std::vector<Real> relax_nodes(NodeForces& forces, const Relaxation& relaxation, Points& places);

}  // namespace gracilis::strings
