#pragma once

#include <gracilis/dynamics/solver/surface_system.hpp>
#include <gracilis/methods/xpbd/preparation.hpp>
#include <gracilis/scene/pose.hpp>

namespace gracilis::xpbd {

/// What of a muscle changes: a copy is a checkpoint. Beside the solver's state, where the strings are that carry it,
/// and where they put its surface.
struct MuscleState : SurfaceState {
  strings::StringState strings;
  std::shared_ptr<const strings::SkinnedSurface> skinned;  ///< by the strings; none: by bodies or a line
  std::shared_ptr<const strings::SkinnedSurface> whole_skinned;  ///< that of which a coarser copy's is a part
};

/// The state in the capture pose of a scene with so many bodies.
MuscleState make_muscle_state(const PreparedMuscle& muscle, std::size_t bodies);

/// Takes the strings that carry a muscle to a pose, and its skinned surface with them. Nothing where there are none.
void follow_strings(const PreparedMuscle& muscle, const Pose& pose, MuscleState& state);

/// The skinned surface for where the strings are.
void skin_by_strings(const PreparedMuscle& muscle, MuscleState& state);

/// The vertices of the skinned surface; null where no strings carry the muscle.
inline const Points* skinned_vertices(const MuscleState& state) {
  return state.skinned ? &state.skinned->vertices : nullptr;
}

/// Attached particles go where their bodies are: T_body x_rest; the ends of tendons, where their lines end.
void move_attached(const PreparedMuscle& muscle, const Pose& pose, Particles& particles);

/// The largest turn from one pose to another of a bone to which the muscle is attached, against another such bone, rad.
Real turn_between(const PreparedMuscle& muscle, const Pose& before, const Pose& now);

/// The predictor: every free particle has a frame of its own: that of the strings which carry the muscle, which are
/// taken to the pose, or the blend of the bodies' motions by its harmonic shares. It keeps its displacement in that
/// frame from `before` to `now`, less the share `shape_recovery`, so that the solver only has to relax and a muscle
/// does not remember by which way it came.
///
/// On the way back to the capture pose a relaxed muscle also keeps no more than in proportion to the turn of its bones
/// from there: where they are as they were, so is the muscle. An active one is displaced by its own pull, too, which
/// knows nothing of that.
///
/// The frames of a muscle made of sections across a line are its sections'; a tendon keeps no displacement.
void skin_free(const PreparedMuscle& muscle, const Pose& before, const Pose& now, bool active, MuscleState& state);

/// Places each obstacle's field where its bone is now.
std::vector<FieldPlacement> place_fields(const PreparedMuscle& muscle, const Pose& pose);

/// The skinned surface: where the strings, or the harmonic shares, alone would put every particle, about the particles'
/// origin, m. It knows no contact but is as smooth as the surface at rest.
Points skinned_rest(const PreparedMuscle& muscle, const Pose& pose, const MuscleState& state);

/// Every particle's displacement from where the bodies carry it, in its own frame at rest, m: what skin_free keeps.
/// The motion of the bodies is taken out, so it varies little from one particle to its neighbors.
Points displacements(const PreparedMuscle& muscle, const Pose& pose, const MuscleState& state);

/// The inverse: carries the rest and displaces it, into `particles`. Attached ones go where their bodies are.
void displace_skinned(const PreparedMuscle& muscle, const Pose& pose, const MuscleState& state,
                      const Points& displacements, Particles& particles);

/// Slack uptake: every edge aims at the length it has on the skinned surface, between 0.4 and `stretch_limit` times its
/// rest, so that a muscle may shorten in front and lengthen behind and nothing is left over to fold. Where the skinned
/// surface encloses more than the muscle's volume it is first shrunk to that, which leaves a stretched muscle taut.
/// Without slack uptake, and where a single body carries the muscle, the targets are the lengths at rest.
void set_target_lengths(const PreparedMuscle& muscle, const Pose& pose, MuscleState& state);

}  // namespace gracilis::xpbd
