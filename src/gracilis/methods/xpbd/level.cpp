#include <gracilis/methods/xpbd/level.hpp>

#include <gracilis/anatomy/resolution/coarser_muscle.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>

#include <exception>
#include <set>

namespace gracilis::xpbd {

namespace {

std::vector<MuscleStep> steps_of(const Level& level, const std::vector<Real>& activations,
                                 std::vector<MuscleState>& next, std::vector<StepCounts>& reports) {
  std::vector<MuscleStep> steps;
  for (std::size_t m = 0; m < level.muscles.size(); ++m)
    steps.push_back({&level.muscles[m], &next[m], &reports[m], activations[m], m, &level.trace});
  return steps;
}

/// Muscles that never meet need not wait for each other.
void advance_each(const Level& level, const std::vector<MuscleStep>& steps, const Pose& before, const Pose& now) {
  std::vector<std::exception_ptr> failures(steps.size());
  parallel_for_each(steps.size(), [&](std::size_t m) {
    try {
      MuscleContactState nobody;
      advance_together({steps[m]}, level.world, nobody, before, now);
    } catch (const QualityError&) {
      failures[m] = std::current_exception();
    }
  });
  // The first in the scene's order, whichever thread was faster.
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

/// What of a copy stands for these vertices.
std::vector<Index> patch_on_copy(const std::vector<Index>& patch, const CoarserMuscle& copy) {
  std::set<Index> on_copy;
  for (const Index v : patch) on_copy.insert(copy.went_to[static_cast<std::size_t>(v)]);
  return {on_copy.begin(), on_copy.end()};
}

/// Velocities of the copy between its vertices.
void prolong_velocities(const Prolongation& prolongation, MuscleState& coarse, MuscleState& full) {
  for (std::size_t p = 0; p < prolongation.corners.size(); ++p) {
    Eigen::Vector3f velocity = Eigen::Vector3f::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      velocity += prolongation.weights[p][static_cast<Index>(k)] * velocity_of(coarse, prolongation.corners[p][k]);
    velocity_of(full, static_cast<Index>(p)) = velocity;
  }
}

}  // namespace

std::vector<CarryingStrings> carrying_strings(const Scene& scene, const strings::BoneDistances& bones) {
  std::vector<CarryingStrings> carrying(scene.muscles.size());
  parallel_for_each(carrying.size(),
                    [&](std::size_t m) { carrying[m] = carrying_strings(scene, scene.muscles[m], bones); });
  return carrying;
}

Level make_level(const Scene& scene, const std::vector<DistanceField>& fields,
                 const std::vector<CarryingStrings>& carrying, bool meet) {
  Level level;
  level.bodies = scene.bodies.size();
  level.muscles.resize(scene.muscles.size());
  level.states.resize(scene.muscles.size());
  parallel_for_each(level.muscles.size(), [&](std::size_t m) {
    level.muscles[m] = prepare_muscle(scene, scene.muscles[m], fields, carrying[m]);
    level.states[m] = make_muscle_state(level.muscles[m], level.bodies);
  });
  level.world = prepare_contact_world(scene, level.muscles, meet);
  level.contact_state = make_contact_state(level.world);
  return level;
}

void reset(Level& level) {
  for (std::size_t m = 0; m < level.muscles.size(); ++m)
    level.states[m] = make_muscle_state(level.muscles[m], level.bodies);
  forget_contact(level.world, level.contact_state);
}

void advance(Level& level, const Pose& before, const Pose& now, const std::vector<Real>& activations,
             std::vector<MuscleState>& next, std::vector<StepCounts>& reports) {
  const std::vector<MuscleStep> steps = steps_of(level, activations, next, reports);
  for (std::size_t m = 0; m < reports.size(); ++m)
    reports[m].triangles = static_cast<Index>(level.muscles[m].faces.cols());
  if (!level.world.meets()) return advance_each(level, steps, before, now);
  const VirtualEdgeState edges = level.contact_state.edges;
  try {
    advance_together(steps, level.world, level.contact_state, before, now);
  } catch (const QualityError&) {
    level.contact_state.edges = edges;
    throw;
  }
}

/// Where muscles lie on others, those below come first in every step.
static void replay_tied_strings(const Level& level, const std::vector<const PreparedMuscle*>& muscles,
                                const std::vector<Pose>& poses, std::vector<MuscleState>& states) {
  const MuscleTies& ties = level.world.ties;
  for (std::size_t m = 0; m < states.size(); ++m)
    if (const CarryingStrings& carrying = level.muscles[m].carrying; carrying.strings) {
      states[m].strings = strings::capture_state(*carrying.strings, level.bodies);
      skin_by_strings(level.muscles[m], states[m]);
    }
  for (std::size_t frame = 1; frame < poses.size(); ++frame)
    for (Pose pose : substep_poses(muscles, poses[frame - 1], poses[frame]))
      for (const std::vector<std::size_t>& group : ties.groups) {
        parallel_for_each(group.size(),
                          [&](std::size_t i) { follow_strings(level.muscles[group[i]], pose, states[group[i]]); });
        place_carried_bodies(
            ties.bodies, group, [&](std::size_t m) { return skinned_vertices(states[m]); }, pose);
      }
}

void replay_strings(const Level& level, const std::vector<Pose>& poses, std::vector<MuscleState>& states) {
  std::vector<const PreparedMuscle*> all;
  for (const PreparedMuscle& muscle : level.muscles) all.push_back(&muscle);
  if (level.world.ties.any()) return replay_tied_strings(level, all, poses, states);
  parallel_for_each(states.size(), [&](std::size_t m) {
    const CarryingStrings& carrying = level.muscles[m].carrying;
    if (!carrying.strings) return;
    states[m].strings = strings::capture_state(*carrying.strings, level.bodies);
    std::vector<const PreparedMuscle*> in_step = {&level.muscles[m]};
    if (level.world.meets()) in_step = all;
    for (std::size_t frame = 1; frame < poses.size(); ++frame)
      for (const Pose& pose : substep_poses(in_step, poses[frame - 1], poses[frame]))
        strings::follow(*carrying.strings, *carrying.bones, pose, states[m].strings);
    skin_by_strings(level.muscles[m], states[m]);
  });
}

CoarserLevel make_coarser_level(const Scene& scene, const Level& full, const std::vector<DistanceField>& fields) {
  Scene copies = scene;
  std::vector<CoarserMuscle> coarser_muscles(scene.muscles.size());
  parallel_for_each(coarser_muscles.size(), [&](std::size_t m) {
    coarser_muscles[m] = coarser_muscle(scene.muscles[m], xpbd_settings(scene, scene.muscles[m]).simulated_edge);
    copies.muscles[m] = coarser_muscles[m].muscle;
  });
  for (MuscleBody& each : copies.muscle_bodies)
    each.patch = patch_on_copy(each.patch, coarser_muscles[static_cast<std::size_t>(each.muscle)]);
  std::vector<CarryingStrings> carrying;
  for (const PreparedMuscle& muscle : full.muscles) carrying.push_back(muscle.carrying);
  CoarserLevel coarser{make_level(copies, fields, carrying), {}};
  for (std::size_t m = 0; m < coarser_muscles.size(); ++m)
    coarser.prolongations.push_back(
        prepare_prolongation(coarser_muscles[m], full.muscles[m], coarser.level.muscles[m]));
  // Copies are carried as the whole surfaces are only from here on.
  reset(coarser.level);
  return coarser;
}

void refine(const CoarserLevel& coarser, Level& full, const Pose& before, const Pose& now,
            const std::vector<Real>& activations, std::vector<MuscleState>& next_coarse,
            std::vector<MuscleState>& next_full, std::vector<StepCounts>& reports) {
  std::vector<Particles> placed(next_full.size());
  parallel_for_each(placed.size(), [&](std::size_t m) {
    placed[m] = next_full[m].particles;
    // The copy is carried by the whole surface, which its strings have already taken along.
    next_full[m].strings = next_coarse[m].strings;
    next_full[m].skinned = next_full[m].whole_skinned = next_coarse[m].whole_skinned;
    prolong(coarser.prolongations[m], coarser.level.muscles[m], next_coarse[m], full.muscles[m], next_full[m], now,
            placed[m]);
  });
  std::vector<StepCounts> refined(reports.size());
  refine_together(steps_of(full, activations, next_full, refined), full.world, full.contact_state, before, now, placed);
  for (std::size_t m = 0; m < reports.size(); ++m) {
    reports[m].contacts = refined[m].contacts;
    reports[m].milliseconds += refined[m].milliseconds;
  }
  for (std::size_t m = 0; m < placed.size(); ++m) {
    restrict_to_copy(coarser.prolongations[m], full.muscles[m], next_full[m].particles, coarser.level.muscles[m],
                     next_coarse[m].particles);
    if (full.muscles[m].settings.time_mode == TimeMode::dynamic)
      prolong_velocities(coarser.prolongations[m], next_coarse[m], next_full[m]);
  }
}

void follow_full(const Level& full, CoarserLevel& coarser) {
  reset(coarser.level);
  for (std::size_t m = 0; m < full.muscles.size(); ++m) {
    const Prolongation& prolongation = coarser.prolongations[m];
    MuscleState from = full.states[m];
    MuscleState& state = coarser.level.states[m];
    state.strings = from.strings;
    skin_by_strings(coarser.level.muscles[m], state);
    restrict_to_copy(prolongation, full.muscles[m], from.particles, coarser.level.muscles[m], state.particles);
    restrict_to_copy(prolongation, full.muscles[m], from.start, coarser.level.muscles[m], state.start);
    for (std::size_t p = 0; p < prolongation.picked.size(); ++p)
      velocity_of(state, static_cast<Index>(p)) = velocity_of(from, prolongation.picked[p]);
  }
}

Index triangle_count(const Level& level) {
  Index count = 0;
  for (const PreparedMuscle& muscle : level.muscles) count += static_cast<Index>(muscle.faces.cols());
  return count;
}

}  // namespace gracilis::xpbd
