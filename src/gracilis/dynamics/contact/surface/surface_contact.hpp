#pragma once

#include <gracilis/dynamics/contact/surface/contact_world.hpp>

#include <vector>

namespace gracilis {

/// Projects all listed contacts: points against faces, then edges against edges, without compliance, each side moving
/// by its inverse masses so that momentum is kept. No particle goes further at once than twice what is missing from the
/// gap, nor further than `most_motion` from `start`, where the step began; momentum is lost where that holds one back.
/// Only movers move; to them the others are as immovable as bones. Returns how many pushed.
Index project_candidates(const ContactWorld& world, const ContactWorldState& state,
                         const std::vector<const Particles*>& start, const std::vector<Particles*>& particles,
                         const Movers& movers = {});

}  // namespace gracilis
