#include <gracilis/opensim/static_optimization/needed_forces.hpp>

#include <gracilis/opensim/kinematics/quintic_spline.hpp>
#include <gracilis/opensim/static_optimization/passive_forces.hpp>

namespace gracilis::opensim {

Kinematics::Kinematics(const CoordinateMotion& the_motion) : motion(the_motion) {
  speeds = quintic_spline(motion.times, motion.values).slopes;
  accelerations = quintic_spline(motion.times, speeds).slopes;
}

AppliedForces outer_forces(Skeleton& skeleton, const Kinematics& kinematics, const ExternalLoads& loads,
                           std::size_t row) {
  const auto i = static_cast<Eigen::Index>(row);
  const Eigen::VectorXd coordinates = kinematics.motion.values.row(i);
  skeleton.place(coordinates);
  AppliedForces forces = passive_forces(skeleton, coordinates, kinematics.speeds.row(i));
  add_loads(loads, kinematics.motion.times[row], skeleton.poses(), forces.bodies);
  return forces;
}

Eigen::VectorXd needed_forces(Skeleton& skeleton, const Kinematics& kinematics, const ExternalLoads& loads,
                              std::size_t row) {
  const auto i = static_cast<Eigen::Index>(row);
  const AppliedForces outer = outer_forces(skeleton, kinematics, loads, row);
  return onto_independent(
      skeleton.model(), kinematics.motion.values.row(i),
      skeleton.inverse_dynamics(kinematics.speeds.row(i), kinematics.accelerations.row(i), outer.bodies) -
          outer.coordinates);
}

}  // namespace gracilis::opensim
