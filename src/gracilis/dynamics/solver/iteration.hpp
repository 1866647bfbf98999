#pragma once

#include <gracilis/dynamics/solver/joint_solve.hpp>

namespace gracilis {

/// Iterates over all surfaces in step, each iteration in the order of constraint_table(), until every surface has had
/// its iterations or stops early; those that stopped wait for the others.
void iterate(JointSolve& solve);

}  // namespace gracilis
