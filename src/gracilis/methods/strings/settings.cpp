#include <gracilis/methods/strings/settings.hpp>

namespace gracilis {

template <>
std::span<const Setting<strings::StringSettings>> setting_table() {
  using S = strings::StringSettings;
  static const Setting<S> table[] = {
      {"strings", &S::count, "", 1, 2000, "How many fibers stand for the muscle."},
      {"segments", &S::segments, "", 2, 1000, "Of each string."},
      {"support_length", &S::support_length, "m", 0.0001, 10,
       "s: what a fiber rested on in the capture pose holds it with the stiffness 1/s² per length, at tension 1."},
      {"support_reach", &S::support_reach, "m", 0.0001, 10,
       "A fiber slides over a bone the less the farther that is at rest, and not at all beyond this, where what holds "
       "it goes with the bodies."},
      {"tie_length", &S::tie_length, "m", 0.0001, 10,
       "s: fascia ties a string across its direction with the stiffness 1/s² per length at a bone ..."},
      {"tie_reach", &S::tie_reach, "m", 0.0001, 10, "... and with nothing this far from bones."},
      {"bone_gap", &S::bone_gap, "m", 0, 0.03,
       "Distance that strings keep to bones, or what they had in the capture pose where that is less."},
      {"bone_stiffness", &S::bone_stiffness, "", 0, 1e4, "Stiffness of bones, over that of a segment of a string."},
      {"neighbor_length", &S::neighbor_length, "m", 0.0001, 10,
       "s: neighboring strings hold their places across each other with the stiffness 1/s² per length."},
      {"neighbors", &S::neighbors, "", 0, 1000, "How many strings are neighbors of each; 0: they know no others."},
      {"share_offset", &S::share_offset, "m", 0.0001, 1,
       "d: a body at the distance x carries what ties and supports a string with a share like 1/(x + d)³."},
      {"pinned_reach", &S::pinned_reach, "m", 0, 1,
       "Where a fiber leaves its bone away from its other end, what lies this near to the bone goes with it."},
      {"iterations", &S::iterations, "", 1, 100000, "Steps of Gauss-Newton for each string in each step of the bones."},
      {"step_turn", &S::step_turn, "rad", 0.001, 3.2,
       "Largest turn of the bones that is taken in one step; frames that turn them further are divided."},
  };
  return table;
}

}  // namespace gracilis
