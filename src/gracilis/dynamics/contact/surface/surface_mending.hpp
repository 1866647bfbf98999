#pragma once

#include <gracilis/dynamics/contact/surface/surface_crowd.hpp>

#include <vector>

namespace gracilis {

/// Mends every mover that keeps out of itself but cuts itself all the same, or has folded (self_cuts.hpp), after a
/// follow_touches (surface_follow.hpp): takes it to its shape at rest there, or smooths it where it is tangled. Contact
/// lets go of what folds on its way out of a surface that it lies in at rest. What cut itself or was folded before the
/// step resisted then and is left alone. Returns whether there was anything to mend, and leaves among the movers what
/// was: it has to settle again.
bool mend_surfaces(const SurfaceCrowd& crowd, CrowdState& state, const std::vector<Particles*>& particles,
                   Movers& movers);

}  // namespace gracilis
