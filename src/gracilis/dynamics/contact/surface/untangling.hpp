#pragma once

#include <gracilis/dynamics/contact/self/self_intersections.hpp>
#include <gracilis/dynamics/contact/surface/contact_world.hpp>

#include <vector>

namespace gracilis {

/// What of a surface cuts itself, or has folded, since rest and since the step began (self_intersections.hpp).
struct Tangle {
  std::vector<FacePair> pairs;
  std::size_t cuts = 0;  ///< the first so many pairs cut each other; the others are folds
};

/// Fewer cuts, or as many and fewer folds.
bool is_less(const Tangle& one, const Tangle& other);

/// The tangles of every mover that keeps out of itself, per surface, after an update_narrow_phase (narrow_phase.hpp);
/// of others none. Folds count where nothing cuts itself, or where they are on the way out of a surface that they lie
/// in at rest: contact lets go of these. What cut itself or was folded before the step resisted then and is left alone.
std::vector<Tangle> find_tangles(const ContactWorld& world, ContactWorldState& state,
                                 const std::vector<const Particles*>& particles, const Movers& movers);

/// Untangles surfaces (unfolding.hpp). In the first attempt (0) of a step a small tangle goes back to where it was
/// `predicted`, where the step began, as far from there as its surroundings went: that is tangled far less than what
/// comes of it. A larger one is smoothed, and gets its shape at rest back in the next attempt: smoothing alone wears a
/// thin tendon down to where it cuts itself for good. What is left after that goes back to the prediction, too.
void untangle(const ContactWorld& world, const std::vector<Tangle>& tangles, int attempt,
              const std::vector<Particles>& predicted, const std::vector<Particles*>& particles);

}  // namespace gracilis
