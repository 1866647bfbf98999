#pragma once

#include <gracilis/methods/xpbd/contact_world.hpp>
#include <gracilis/methods/xpbd/preparation.hpp>
#include <gracilis/methods/xpbd/prolongation.hpp>
#include <gracilis/methods/xpbd/step.hpp>
#include <gracilis/scene/pose.hpp>

#include <vector>

namespace gracilis::xpbd {

/// All muscles of a scene, whole or as coarser copies, as they are prepared and as they are now.
struct Level {
  std::vector<PreparedMuscle> muscles;
  std::vector<MuscleState> states;
  MuscleContactWorld world;
  MuscleContactState contact_state;
  std::size_t bodies = 0;  ///< of the scene
  PassTrace trace = {};    ///< called after every pass of the solver
};

/// The strings that carry each muscle of a scene (carrying_strings).
std::vector<CarryingStrings> carrying_strings(const Scene& scene, const strings::BoneDistances& bones);

/// Prepares a level, at rest. `fields` as in prepare_muscle, `carrying` one per muscle; muscles that do not `meet` have
/// no contact.
Level make_level(const Scene& scene, const std::vector<DistanceField>& fields,
                 const std::vector<CarryingStrings>& carrying, bool meet = true);

/// Takes the strings of muscles at rest through the frames of a run, in the same steps as `advance`.
void replay_strings(const Level& level, const std::vector<Pose>& poses, std::vector<MuscleState>& states);

/// Back to rest.
void reset(Level& level);

/// Moves `next`, a copy of the level's states, from one pose to the next. Throws QualityError; `next` is then of no use
/// and the level as it was.
void advance(Level& level, const Pose& before, const Pose& now, const std::vector<Real>& activations,
             std::vector<MuscleState>& next, std::vector<StepCounts>& reports);

/// Coarser copies of a scene's muscles that are simulated in their place.
struct CoarserLevel {
  Level level;
  std::vector<Prolongation> prolongations;
};

/// Copies with the edge lengths that the muscles' settings ask for (`simulated_edge`); muscles that ask for none are
/// copied whole.
CoarserLevel make_coarser_level(const Scene& scene, const Level& full, const std::vector<DistanceField>& fields);

/// Takes the whole surfaces (`next_full`, a copy of their states) to where the copies (`next_coarse`) are, refines them
/// there, and puts the copies back onto them. Throws as `advance`.
void refine(const CoarserLevel& coarser, Level& full, const Pose& before, const Pose& now,
            const std::vector<Real>& activations, std::vector<MuscleState>& next_coarse,
            std::vector<MuscleState>& next_full, std::vector<StepCounts>& reports);

/// Puts the copies' states where those of the whole surfaces are.
void follow_full(const Level& full, CoarserLevel& coarser);

/// Triangles of all muscles.
Index triangle_count(const Level& level);

}  // namespace gracilis::xpbd
