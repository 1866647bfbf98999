#pragma once

#include <gracilis/methods/tissue/preparation.hpp>

#include <vector>

namespace gracilis::tissue {

/// In how many steps a muscle wants to go from one pose to another: so many that its carriers turn by no more than
/// `largest_turn` (rad) about each other and move by no more than a cell in each, but 8 at most.
int steps_needed(const PreparedTissue& muscle, const std::vector<RigidTransform>& before,
                 const std::vector<RigidTransform>& now);

/// Where the bodies are after so many steps of `count`: after the last one at `now`.
std::vector<RigidTransform> bodies_after(int steps, int count, const PreparedTissue& muscle,
                                         const std::vector<RigidTransform>& before,
                                         const std::vector<RigidTransform>& now);

/// What the minimizer leaves a tetrahedron of its volume at least, unless it had less before: with next to nothing left
/// its forces are so large that no step leads on.
inline constexpr Real least_settled_ratio = 0.02;

/// Moves the nodes with their shares of what the carriers move by, and less where a tetrahedron would invert. All move
/// rigidly where the carriers do so together.
void carry(const PreparedTissue& muscle, const std::vector<RigidTransform>& before,
           const std::vector<RigidTransform>& now, Points& nodes);

}  // namespace gracilis::tissue
