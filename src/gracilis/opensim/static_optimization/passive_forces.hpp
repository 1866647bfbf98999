#pragma once

#include <gracilis/opensim/kinematics/skeleton.hpp>

namespace gracilis::opensim {

/// Generalized forces (N·m or N, per coordinate) of a model's passive forces that apply, for these coordinates and
/// speeds; formulas as OpenSim's sources have them (docs/mathematics.md). Leaves the skeleton placed at the
/// coordinates. What they do to dependent coordinates is not yet taken into those that these depend on
/// (onto_independent).
Eigen::VectorXd passive_forces(Skeleton& skeleton, const Eigen::VectorXd& coordinates, const Eigen::VectorXd& speeds);

}  // namespace gracilis::opensim
