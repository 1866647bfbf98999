#pragma once

#include <gracilis/opensim/kinematics/coordinate_motion.hpp>
#include <gracilis/opensim/kinematics/external_loads.hpp>

namespace gracilis::opensim {

/// A motion with its speeds and accelerations, by quintic splines through all rows: those of the speeds through the
/// slopes of the coordinates', as OpenSim does. Keeps a reference to the motion.
struct Kinematics {
  const CoordinateMotion& motion;
  Eigen::MatrixXd speeds, accelerations;
  /// Fits the splines; the motion must outlive it.
  explicit Kinematics(const CoordinateMotion& the_motion);
};

/// What acts on a model in a row of a motion beside gravity, muscles and actuators: loads and passive forces. Places
/// the skeleton.
AppliedForces outer_forces(Skeleton& skeleton, const Kinematics& kinematics, const ExternalLoads& loads,
                           std::size_t row);

/// Generalized forces that muscles and actuators must give in a row; those on dependent coordinates are taken into the
/// ones that these depend on. Places the skeleton.
Eigen::VectorXd needed_forces(Skeleton& skeleton, const Kinematics& kinematics, const ExternalLoads& loads,
                              std::size_t row);

}  // namespace gracilis::opensim
