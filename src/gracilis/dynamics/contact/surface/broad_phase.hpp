#pragma once

#include <gracilis/dynamics/contact/self/self_contact.hpp>
#include <gracilis/dynamics/contact/surface/contact_world.hpp>

#include <vector>

namespace gracilis {

/// How far anything near each other of a pair has moved at most, m, since the last look, against what it was near to
/// then.
float largest_drift(const ContactWorld& world, const std::vector<const Particles*>& particles, const SurfacePair& pair,
                    const PairCandidates& candidates);

/// How the parts of a surface, whose particles are given, may meet in this step.
SelfRule self_rule(const ContactWorld& world, const ContactWorldState& state, const Particles& particles,
                   Index surface);

/// Finds what is near what, after a step's prediction. A pair is searched, from nothing but where the particles are,
/// when what was found before cannot be trusted: when anything near has moved too far against what it is near to, for
/// what was not near may have come as far, or when it was found a few steps ago.
void update_broad_phase(const ContactWorld& world, const std::vector<const Particles*>& particles,
                        ContactWorldState& state);

}  // namespace gracilis
