#pragma once

#include <gracilis/opensim/static_optimization/muscle_curves.hpp>

namespace gracilis::opensim {

/// The force (N) that OpenSim's static optimization takes a fully active muscle to pull with: on a tendon that keeps
/// its slack length, maximum isometric force times the factors of fiber length and of fiber velocity, times the cosine
/// of the pennation angle, without passive force (Muscle::calcInextensibleTendonActiveFiberForce). Two cosines are not
/// what they should be there, and are followed: DeGrooteFregly2016Muscle has none, and Millard2012EquilibriumMuscle
/// that of the angle at a fiber of the normalized length, in metres. `length` (m) and `speed` (m/s, longer is positive)
/// are the path's. Zero where the path is shorter than the slack tendon, or the fibers stand too steep.
Real rigid_tendon_force(const Muscle& muscle, Real length, Real speed);

}  // namespace gracilis::opensim
