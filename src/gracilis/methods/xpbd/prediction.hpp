#pragma once

#include <gracilis/dynamics/solver/surface_solve.hpp>
#include <gracilis/methods/xpbd/motion.hpp>
#include <gracilis/methods/xpbd/preparation.hpp>
#include <gracilis/scene/pose.hpp>

namespace gracilis::xpbd {

/// How a substep of a relaxed muscle is solved, one of `substeps` in its frame. In quasi-static mode those that the
/// size of the motion asks for have no shorter time, because they stand for frames. Whatever solves or times a part of
/// a step takes its settings from here.
SolveSettings solve_settings(const XpbdSettings& settings, int substeps);

/// What the predictor does: carries the particles (skin_free, for muscles that are `active` or not) and, where it is
/// asked for, brings them nearer to an as-rigid-as-possible surface.
void carry(const PreparedMuscle& muscle, bool active, const Pose& before, const Pose& pose, MuscleState& state);

/// Moves the state from one pose to another as far as bones and inertia alone tell: what the solver begins with.
/// `time_step` (s) is the substep's.
void predict(const PreparedMuscle& muscle, Real activation, const Pose& before, const Pose& pose, float time_step,
             MuscleState& state);

}  // namespace gracilis::xpbd
