#include <gracilis/methods/xpbd/step.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/havlicek_2024/virtual_edge_seeds.hpp>
#include <gracilis/dynamics/solver/bone_contact.hpp>
#include <gracilis/dynamics/solver/constraint_table.hpp>
#include <gracilis/dynamics/solver/solver.hpp>
#include <gracilis/geometry/screw.hpp>
#include <gracilis/methods/xpbd/contraction.hpp>
#include <gracilis/methods/xpbd/coupling.hpp>
#include <gracilis/methods/xpbd/motion.hpp>
#include <gracilis/methods/xpbd/pass_recorder.hpp>
#include <gracilis/methods/xpbd/prediction.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace gracilis::xpbd {

void take_velocities(float time_step, SurfaceState& state) {
  for (Index p = 0; p < state.particles.count(); ++p)
    velocity_of(state, p) = (state.particles.position(p) - state.start.position(p)) / time_step;
}

namespace {

/// Into how many steps the settings and the turn of the muscle's bones against each other divide a frame.
int substeps_of(const PreparedMuscle& muscle, const Pose& before, const Pose& now) {
  const XpbdSettings& settings = muscle.settings;
  const Real turn = turn_between(muscle, before, now);
  if (!(settings.step_turn > 0) || !std::isfinite(turn)) return settings.substeps;
  constexpr Real rounding = 1e-6;
  return settings.substeps * std::max(1, static_cast<int>(std::ceil(turn / settings.step_turn - rounding)));
}

/// Where the bodies are `share` of the way from one pose to the next, for substeps, each along its own screw: on a
/// hinge it stays on the hinge, wherever the frame's origin is.
Pose pose_between(const Pose& before, const Pose& now, Real share) {
  if (share >= 1) return now;
  Pose pose = now;
  for (std::size_t b = 0; b < pose.bodies.size(); ++b)
    pose.bodies[b] = share_of_screw(now.bodies[b] * before.bodies[b].inverse(), share) * before.bodies[b];
  for (std::size_t c = 0; c < std::min(before.coordinates.size(), now.coordinates.size()); ++c)
    pose.coordinates[c] = (1 - share) * before.coordinates[c] + share * now.coordinates[c];
  return pose;
}

/// Moves the state to where a coarser copy put the surface.
void place(const PreparedMuscle& muscle, Real activation, const Pose& pose, const Particles& placed,
           MuscleState& state) {
  state.particles = placed;
  state.start = placed;
  if (muscle.settings.full_iterations == 0) return;
  set_target_lengths(muscle, pose, state);
  set_contraction_lengths(muscle, activation, state.skinned.get(), state.tension_length);
}

/// The first thing after which a coordinate was not finite.
struct Failure {
  std::size_t muscle = 0;
  ConstraintKind kind = ConstraintKind::none;
};

/// Solves again from the prediction and watches.
Failure find_failure(std::vector<SurfaceSolve>& solves, const std::vector<Particles>& predicted,
                     const std::vector<MuscleStep>& steps, const MuscleContactWorld& world,
                     MuscleContactState& contact_state) {
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i].state->particles = predicted[i];
  std::vector<std::optional<ConstraintKind>> first(steps.size());
  solve_together(solves, couple(steps, predicted, world, contact_state), [&](std::size_t i, ConstraintKind kind) {
    if (!first[i] && !is_finite(steps[i].state->particles)) first[i] = kind;
  });
  for (std::size_t i = 0; i < first.size(); ++i)
    if (first[i]) return {i, *first[i]};
  return {};
}

[[noreturn]] void throw_failure(const std::vector<MuscleStep>& steps, const Failure& failure) {
  const std::string muscle = "muscle " + steps[failure.muscle].muscle->name;
  throw QualityError(muscle + ": a vertex position is not finite after the " + name_of(failure.kind) +
                     " constraint; soften the material or raise `iterations`");
}

void add_to(StepCounts& report, const SolveReport& solved, Real correction) {
  report.iterations += solved.iterations;
  report.contacts = solved.contacts;
  report.limited_dihedrals += solved.limited_dihedrals;
  report.limited_edges += solved.limited_edges;
  report.skipped_constraints += solved.skipped_constraints;
  report.largest_correction = std::max(report.largest_correction, correction);
  report.milliseconds += solved.milliseconds;
}

/// What a substep of all muscles is solved from.
struct Substep {
  std::vector<SurfaceSolve> solves;
  std::vector<std::vector<FieldPlacement>> placements;
  std::vector<Particles> predicted;  ///< where the solver begins
  VirtualEdgeState edges_before;
};

/// Before anything moves: contact remembers where everything is.
Substep begin_substep(const std::vector<MuscleStep>& steps, const MuscleContactWorld& world,
                      MuscleContactState& contact_state) {
  if (!world.edges.pairs.empty()) remember_positions(particles_of<const Particles*>(steps), contact_state.edges);
  if (!world.surfaces.pairs.empty()) remember_places(particles_of<const Particles*>(steps), contact_state.surfaces);
  const std::size_t count = steps.size();
  return {std::vector<SurfaceSolve>(count), std::vector<std::vector<FieldPlacement>>(count),
          std::vector<Particles>(count), contact_state.edges};
}

/// Moves the bones of one muscle, which remembers on which side of each it is.
void move_bones(const MuscleStep& step, int substeps, const Pose& before, const Pose& now,
                std::vector<FieldPlacement>& placements, SurfaceSolve& solve) {
  const PreparedMuscle& muscle = *step.muscle;
  solve = {&muscle.system, &placements, solve_settings(muscle.settings, substeps), step.state, {}};
  solve.settings.tension = {static_cast<float>(contraction_strength(muscle.contraction, step.activation)),
                            muscle.contraction.two_sided};
  placements = place_fields(muscle, now);
  remember_sides(muscle.system, place_fields(muscle, before), *step.state);
}

/// Puts ends that lie on muscles where these are: now, or where the step began.
void hold_ends(const MuscleTies& ties, const std::vector<MuscleStep>& steps, Particles SurfaceState::*places) {
  for (const TiedSurfaces& tied : ties.surfaces)
    place_on_host(tied, steps[static_cast<std::size_t>(tied.host)].state->*places,
                  steps[static_cast<std::size_t>(tied.guest)].state->*places);
}

/// Solves from the prediction and adds to the reports. On failure the world is as it was.
void solve_predicted(const std::vector<MuscleStep>& steps, const MuscleContactWorld& world,
                     MuscleContactState& contact_state, Substep& substep) {
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (!is_finite(substep.predicted[i]))
      throw QualityError("muscle " + steps[i].muscle->name +
                         ": a vertex position is not finite before the solver; check the pose and the velocities");
  solve_together(substep.solves, couple(steps, substep.predicted, world, contact_state),
                 record_passes(steps, substep.solves));
  const auto is_lost = [](const MuscleStep& step) { return !is_finite(step.state->particles); };
  if (std::any_of(steps.begin(), steps.end(), is_lost)) {
    contact_state.edges = substep.edges_before;
    forget_candidates(contact_state.surfaces);
    throw_failure(steps, find_failure(substep.solves, substep.predicted, steps, world, contact_state));
  }
  hold_ends(world.ties, steps, &SurfaceState::particles);
  parallel_for_each(steps.size(), [&](std::size_t i) {
    const float correction = largest_motion(substep.predicted[i], steps[i].state->particles);
    add_to(*steps[i].report, substep.solves[i].report, static_cast<Real>(correction));
  });
}

/// Puts the bodies that muscles carry where their strings have them now.
void see_carried_bodies(const MuscleTies& ties, const std::vector<MuscleStep>& steps,
                        const std::vector<std::size_t>& muscles, Pose& pose) {
  place_carried_bodies(
      ties.bodies, muscles, [&](std::size_t m) { return skinned_vertices(*steps[m].state); }, pose);
}

/// Calls act(i) for each muscle, side by side, but for those that lie on others after these, which then carry what lies
/// on them to `pose`.
template <class Act>
void for_each_group(const MuscleTies& ties, const std::vector<MuscleStep>& steps, Pose& pose, const Act& act) {
  if (!ties.any()) return parallel_for_each(steps.size(), act);
  for (const std::vector<std::size_t>& group : ties.groups) {
    parallel_for_each(group.size(), [&](std::size_t i) { act(group[i]); });
    see_carried_bodies(ties, steps, group, pose);
  }
}

/// One of `substeps` steps of a frame: bones and inertia predict, the solver corrects. The bodies that muscles carry
/// are put into `now` where they are.
void advance_substep(const std::vector<MuscleStep>& steps, const MuscleContactWorld& world,
                     MuscleContactState& contact_state, int substeps, const Pose& before, Pose& now) {
  Substep substep = begin_substep(steps, world, contact_state);
  const auto time_step = [&](std::size_t i) { return static_cast<float>(substep.solves[i].settings.time_step); };
  for_each_group(world.ties, steps, now, [&](std::size_t i) {
    const MuscleStep& step = steps[i];
    move_bones(step, substeps, before, now, substep.placements[i], substep.solves[i]);
    predict(*step.muscle, step.activation, before, now, time_step(i), *step.state);
  });
  for (const auto places : {&SurfaceState::particles, &SurfaceState::start}) hold_ends(world.ties, steps, places);
  for (std::size_t i = 0; i < steps.size(); ++i) substep.predicted[i] = steps[i].state->particles;
  solve_predicted(steps, world, contact_state, substep);
  parallel_for_each(steps.size(), [&](std::size_t i) {
    if (steps[i].muscle->settings.time_mode == TimeMode::dynamic) take_velocities(time_step(i), *steps[i].state);
  });
}

/// Adds each pair's counts to both of its muscles.
void report_edges(const VirtualEdgeWorld& world, const VirtualEdgeState& state, const std::vector<MuscleStep>& steps) {
  for (std::size_t i = 0; i < world.pairs.size(); ++i)
    for (const Index surface : {world.pairs[i].first, world.pairs[i].second}) {
      StepCounts& report = *steps[static_cast<std::size_t>(surface)].report;
      report.virtual_edges += static_cast<Index>(state.pairs[i].edges.size());
      report.virtual_pushes += state.pairs[i].pushes;
      report.coinciding_edges += state.pairs[i].coinciding;
    }
}

}  // namespace

std::vector<Pose> substep_poses(const std::vector<const PreparedMuscle*>& muscles, const Pose& before,
                                const Pose& now) {
  int substeps = 1;
  for (const PreparedMuscle* muscle : muscles) substeps = std::max(substeps, substeps_of(*muscle, before, now));
  std::vector<Pose> poses;
  for (int substep = 1; substep <= substeps; ++substep)
    poses.push_back(pose_between(before, now, static_cast<Real>(substep) / substeps));
  return poses;
}

void advance_together(const std::vector<MuscleStep>& steps, const MuscleContactWorld& world,
                      MuscleContactState& contact_state, const Pose& before, const Pose& now) {
  std::vector<const PreparedMuscle*> muscles;
  for (const MuscleStep& step : steps) muscles.push_back(step.muscle);
  const std::vector<Pose> poses = substep_poses(muscles, before, now);
  begin_contact_frame(world.surfaces, contact_state.surfaces);
  begin_edge_frame(world.edges, particles_of<const Particles*>(steps), contact_state.edges);
  Pose reached = before;
  for (const std::vector<std::size_t>& group : world.ties.groups) see_carried_bodies(world.ties, steps, group, reached);
  for (Pose pose : poses) {
    advance_substep(steps, world, contact_state, static_cast<int>(poses.size()), reached, pose);
    reached = std::move(pose);
  }
  end_edge_frame(world.edges, contact_state.edges);
  report_edges(world.edges, contact_state.edges, steps);
}

void refine_together(const std::vector<MuscleStep>& steps, const MuscleContactWorld& world,
                     MuscleContactState& contact_state, const Pose& before, const Pose& now,
                     const std::vector<Particles>& placed) {
  Substep substep = begin_substep(steps, world, contact_state);
  parallel_for_each(steps.size(), [&](std::size_t i) {
    const MuscleStep& step = steps[i];
    SurfaceSolve& solve = substep.solves[i];
    move_bones(step, 1, before, now, substep.placements[i], solve);
    solve.settings.iterations = step.muscle->settings.full_iterations;
    place(*step.muscle, step.activation, now, placed[i], *step.state);
    if (solve.settings.iterations == 0) refresh_contacts(step.muscle->system, substep.placements[i], *step.state);
  });
  hold_ends(world.ties, steps, &SurfaceState::particles);
  for (std::size_t i = 0; i < steps.size(); ++i) substep.predicted[i] = steps[i].state->particles;
  solve_predicted(steps, world, contact_state, substep);
}

}  // namespace gracilis::xpbd
