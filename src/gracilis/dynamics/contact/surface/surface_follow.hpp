#pragma once

#include <gracilis/dynamics/contact/surface/surface_crowd.hpp>

#include <vector>

namespace gracilis {

/// Follows what was found to where it is now and lists what the next iterations have to project. Where hardly anything
/// has moved within a step the lists stay. Pairs of which neither is among the movers have not moved since.
void follow_touches(const SurfaceCrowd& crowd, const std::vector<const Particles*>& particles, CrowdState& state,
                    const Movers& movers = {});

}  // namespace gracilis
