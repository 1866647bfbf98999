#pragma once

#include <gracilis/dynamics/solver.hpp>
#include <gracilis/methods/xpbd/preparation.hpp>
#include <gracilis/scene/pose.hpp>

namespace gracilis::xpbd {

/// Attached particles go where their bodies are: T_body x_rest.
void move_attached(const PreparedMuscle& muscle, const Pose& pose, Particles& particles);

/// The predictor: every free particle has a frame of its own, the blend of the bodies' motions by its harmonic shares. It keeps
/// its displacement in that frame from `before` to `now`, less the share `shape_recovery`, so that the solver only has to
/// relax and a muscle does not remember by which way it came.
void carry_free(const PreparedMuscle& muscle, const Pose& before, const Pose& now, Particles& particles);

/// Places each obstacle's field where its bone is now.
std::vector<FieldPlacement> place_fields(const PreparedMuscle& muscle, const Pose& pose);

/// Slack uptake: with r ≤ 1 the ratio of the span between the ends to that at rest, an edge with cosine c to the fibers
/// gets the target length l √(c² r² + (1 - c²)/r): relaxed fibers take the shorter length evenly and the belly thickens
/// at constant volume. Without it the targets are the lengths at rest.
void set_target_lengths(const PreparedMuscle& muscle, const Pose& pose, AlignedVector<float>& target_length);

}  // namespace gracilis::xpbd
