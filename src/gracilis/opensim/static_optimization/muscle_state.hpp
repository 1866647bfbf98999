#pragma once

#include <gracilis/opensim/static_optimization/muscle_curves.hpp>

namespace gracilis::opensim {

/// What a muscle's force is made of.
enum class MuscleForces {
  opensim,  ///< activation times rigid_tendon_force
  rigid,    ///< active and passive force of fibers on a tendon that keeps its slack length
  elastic   ///< the same on an elastic tendon, unless the model ignores its compliance
};

struct MuscleState {
  Real force = 0;         ///< N, along the tendon
  Real fiber_length = 0;  ///< m
  Real fiber_speed = 0;   ///< m/s, longer is positive
};

/// A muscle at an activation (0 to 1) on a path of this length (m) and speed (m/s): F = F_max (a f_l f_v + f_p + d v)
/// cos φ, never below zero, equals the tendon's force. With an elastic tendon fibers and tendon share the path's speed
/// by their stiffnesses, at constant activation (Millard et al. 2013, as OpenSim's initial equilibrium does).
MuscleState muscle_state(const Muscle& muscle, Real activation, Real length, Real speed, bool elastic);

}  // namespace gracilis::opensim
