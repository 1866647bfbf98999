#pragma once

#include <gracilis/dynamics/contact/surface/contact_world.hpp>

#include <vector>

namespace gracilis {

/// Follows what was found to where it is now and lists what the next iterations have to project. Where hardly anything
/// has moved within a step the lists stay. Pairs of which neither is among the movers have not moved since.
void update_narrow_phase(const ContactWorld& world, const std::vector<const Particles*>& particles,
                         ContactWorldState& state, const Movers& movers = {});

}  // namespace gracilis
