#pragma once

#include <gracilis/dynamics/solver/joint_solve.hpp>

namespace gracilis {

/// Lets the movers settle after the last iteration: the strain limit, then rounds of volume, contact between surfaces,
/// strain limit, slivers, rest proximities and bone contact, as many as each surface asks for, and more for those whose
/// volume is still off. What contact takes from the volume, or the volume presses into a neighbor, is shared out
/// between them, by where everything is now.
void settle(JointSolve& solve);

/// What contact between surfaces, or untangling, has torn or squeezed recovers without them.
void recover(JointSolve& solve);

/// What then still lies deep in another surface is taken out of it, together with what lies around it
/// (penetration_repair.hpp).
void repair(JointSolve& solve);

}  // namespace gracilis
