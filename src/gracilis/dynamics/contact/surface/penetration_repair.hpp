#pragma once

#include <gracilis/dynamics/contact/surface/contact_world.hpp>

#include <vector>

namespace gracilis {

/// Takes particles that lie deeper in another surface than the two lay in each other around them at rest out of it, to
/// that depth, half of the way each where both can move. What lies around them on either surface goes along, the less
/// the farther it is, so that no edge is stretched far: single particles that a pull drew through a surface would only
/// be drawn back. Call it after update_narrow_phase (narrow_phase.hpp). Returns which surfaces it moved; none where
/// nothing lies deep.
std::vector<char> repair_penetrations(const ContactWorld& world, const ContactWorldState& state,
                                      const std::vector<Particles*>& particles);

}  // namespace gracilis
