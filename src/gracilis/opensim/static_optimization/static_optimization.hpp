#pragma once

#include <gracilis/opensim/kinematics/coordinate_motion.hpp>
#include <gracilis/opensim/kinematics/external_loads.hpp>
#include <gracilis/opensim/static_optimization/muscle_state.hpp>

#include <functional>

namespace gracilis::opensim {

struct StaticOptimizationSettings {
  Real exponent = 2;                  ///< minimize the sum of |activation|^exponent over muscles and actuators
  bool use_muscle_physiology = true;  ///< forces depend on length and velocity; otherwise on activation alone
  MuscleForces muscle_forces = MuscleForces::opensim;
};

/// An instant at which no activations within their limits give the motion: what is missing, by coordinate.
struct InfeasibleInstant {
  Real time = 0;
  std::vector<std::pair<std::string, Real>> missing;  ///< N·m or N, the largest first
};

struct StaticOptimizationResult {
  Table activations;    ///< of muscles and actuators, a column each
  Table forces;         ///< N (N·m), the same columns
  Table fiber_lengths;  ///< m, a column per muscle; without columns where fibers are not looked at
                        ///< (MuscleForces::opensim)
  std::vector<InfeasibleInstant> infeasible;
};

/// The activations with the least cost that give the generalized forces of a motion (Anderson and Pandy 2001;
/// Crowninshield and Brand 1981), at the given rows. A muscle's force is its activation times rigid_tendon_force (or
/// its maximum isometric force), as in OpenSim, or that of muscle_state, which does not grow evenly with activation:
/// then problems follow each other in which it does, until activations stay. An actuator's force is its control times
/// its optimal force. Passive forces of the model do their part beforehand (needed_forces). Locked coordinates ask for
/// nothing, dependent ones work through their couplers, and what closes loops holds what it must. `progress` is told
/// every finished row.
StaticOptimizationResult static_optimization(const Model& model, const CoordinateMotion& motion,
                                             const ExternalLoads& loads, const std::vector<std::size_t>& rows,
                                             const StaticOptimizationSettings& settings,
                                             const std::function<void(std::size_t)>& progress = {});

/// Generalized forces of the motion (OpenSim's inverse dynamics), a column per coordinate, N·m or N.
Table inverse_dynamics(const Model& model, const CoordinateMotion& motion, const ExternalLoads& loads,
                       const std::vector<std::size_t>& rows);

}  // namespace gracilis::opensim
