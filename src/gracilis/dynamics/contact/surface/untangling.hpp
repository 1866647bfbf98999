#pragma once

#include <gracilis/dynamics/contact/surface/contact_world.hpp>

#include <vector>

namespace gracilis {

/// Untangles every mover that keeps out of itself but cuts itself all the same, or has folded (self_intersections.hpp),
/// after an update_narrow_phase (narrow_phase.hpp): takes it to its shape at rest there (unfolding.hpp). A tangle is
/// smoothed in the first attempt (0) of a step and gets its shape back in later ones: smoothing alone wears a thin
/// tendon down to where it cuts itself for good. Contact lets go of what folds on its way out of a surface that it lies
/// in at rest. What cut itself or was folded before the step resisted then and is left alone. Returns whether there was
/// anything to untangle, and leaves among the movers what was: it has to settle again.
bool untangle_surfaces(const ContactWorld& world, ContactWorldState& state, const std::vector<Particles*>& particles,
                       int attempt, Movers& movers);

}  // namespace gracilis
