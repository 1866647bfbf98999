#pragma once

#include <gracilis/opensim/kinematics/skeleton.hpp>

namespace gracilis::opensim {

/// What a model's passive forces that apply do at these coordinates and speeds, on bodies and coordinates; formulas as
/// OpenSim's sources have them (docs/mathematics.md). Leaves the skeleton placed at the coordinates.
AppliedForces passive_forces(Skeleton& skeleton, const Eigen::VectorXd& coordinates, const Eigen::VectorXd& speeds);

}  // namespace gracilis::opensim
