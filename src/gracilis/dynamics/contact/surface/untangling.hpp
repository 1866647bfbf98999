#pragma once

#include <gracilis/dynamics/contact/surface/contact_world.hpp>

#include <vector>

namespace gracilis {

/// Untangles every mover that keeps out of itself but cuts itself all the same, or has folded (self_intersections.hpp),
/// after a update_narrow_phase (narrow_phase.hpp): takes it to its shape at rest there, or smooths it where it is
/// tangled. Contact lets go of what folds on its way out of a surface that it lies in at rest. What cut itself or was
/// folded before the step resisted then and is left alone. Returns whether there was anything to untangle, and leaves
/// among the movers what was: it has to settle again.
bool untangle_surfaces(const ContactWorld& world, ContactWorldState& state, const std::vector<Particles*>& particles,
                       Movers& movers);

}  // namespace gracilis
