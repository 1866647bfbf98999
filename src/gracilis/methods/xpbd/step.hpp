#pragma once

#include <gracilis/methods/pass_tracing.hpp>
#include <gracilis/methods/xpbd/contact_world.hpp>
#include <gracilis/methods/xpbd/motion.hpp>
#include <gracilis/methods/xpbd/preparation.hpp>
#include <gracilis/methods/xpbd/step_counts.hpp>
#include <gracilis/scene/pose.hpp>

#include <vector>

namespace gracilis::xpbd {

/// One of the muscles that are advanced in step.
struct MuscleStep {
  const PreparedMuscle* muscle = nullptr;
  MuscleState* state = nullptr;
  StepCounts* report = nullptr;
  Real activation = 0;
  std::size_t number = 0;            ///< of the muscle in the scene
  const PassTrace* trace = nullptr;  ///< called after every pass; may be empty or none
};

/// The poses that a frame of muscles which are advanced in step goes through: as many as the settings of the most
/// demanding ask for, the last is `now`.
std::vector<Pose> substep_poses(const std::vector<const PreparedMuscle*>& muscles, const Pose& before, const Pose& now);

/// Moves the muscles from one pose to the next, in as many substeps as the most demanding of them asks for. `world`
/// says how they meet, its surfaces in the order of `steps`; without pairs they do not. Throws QualityError that names
/// the muscle and the kind of constraint after which a coordinate is not finite; the states are then of no use.
void advance_together(const std::vector<MuscleStep>& steps, const MuscleContactWorld& world,
                      MuscleContactState& contact_state, const Pose& before, const Pose& now);

/// Takes whole surfaces to where their coarser copies put them (`placed`, in the order of `steps`) and solves them
/// there: `full_iterations`, then the settling rounds. Otherwise as above.
void refine_together(const std::vector<MuscleStep>& steps, const MuscleContactWorld& world,
                     MuscleContactState& contact_state, const Pose& before, const Pose& now,
                     const std::vector<Particles>& placed);

/// v = (x - x_start) / time step, for all particles.
void take_velocities(float time_step, SurfaceState& state);

/// The velocity of a particle, m/s.
inline Eigen::Map<Eigen::Vector3f> velocity_of(SurfaceState& state, Index particle) {
  return Eigen::Map<Eigen::Vector3f>(state.velocities.data() + 3 * static_cast<std::size_t>(particle));
}

}  // namespace gracilis::xpbd
