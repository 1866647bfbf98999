#pragma once

#include <gracilis/dynamics/constraints/constraint_sets.hpp>

#include <vector>

namespace gracilis {

/// Which edges may come to a limit of stretch: most never do, and looking at all of them costs as much as projecting
/// them.
struct StretchWatch {
  float limit = 0;            ///< longest an edge may be, over its length at rest
  AlignedVector<float> from;  ///< m, per slot of distances: an edge of this length may reach the limit in one iteration
  std::vector<char> groups;   ///< one entry per group_width slots; not 0 where one was as long when last projected
};

/// Begins to watch the edges of a set, in all groups at first; does nothing where it watches them for this limit
/// already.
void watch_stretch(const DistanceSet& set, float limit, StretchWatch& watch);

/// Has no group looked at, for what projecting distances will note.
void look_nowhere(StretchWatch& watch);

/// Has all groups looked at, until distances are projected again: something else moved the particles.
void look_everywhere(StretchWatch& watch);

}  // namespace gracilis
