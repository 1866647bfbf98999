#include <gracilis/methods/xpbd/step.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/screw.hpp>
#include <gracilis/methods/xpbd/contraction.hpp>
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
  set_contraction_lengths(muscle, activation, state.skinned.get(), state.contraction_length);
}

template <class Pointer>
std::vector<Pointer> particles_of(const std::vector<MuscleStep>& steps) {
  std::vector<Pointer> particles;
  for (const MuscleStep& step : steps) particles.push_back(&step.state->particles);
  return particles;
}

Coupling couple_by_surfaces(const std::vector<MuscleStep>& steps, const SurfaceCrowd& crowd, CrowdState& state) {
  const auto particles = particles_of<Particles*>(steps);
  const auto seen = particles_of<const Particles*>(steps);
  std::vector<const Particles*> start;
  for (const MuscleStep& step : steps) start.push_back(&step.state->start);
  find_touches(crowd, seen, state);
  return {[&crowd, &state, seen](const Movers& movers) { follow_touches(crowd, seen, state, movers); },
          [&crowd, &state, start, particles](const Movers& movers) {
            return project_touches(crowd, state, start, particles, movers);
          },
          [&crowd, &state, particles](Movers& movers, int attempt) {
            return mend_surfaces(crowd, state, attempt, particles, movers);
          }};
}

Coupling couple_by_edges(const std::vector<MuscleStep>& steps, const VirtualEdgeCrowd& crowd, VirtualEdgeState& state) {
  const auto particles = particles_of<Particles*>(steps);
  adapt_distances(crowd, particles_of<const Particles*>(steps), state);
  return {[](const Movers&) {},
          [&crowd, &state, particles](const Movers&) { return project_virtual_edges(crowd, particles, state); }};
}

/// What acts between the muscles of a crowd, from where they are predicted.
Coupling couple(const std::vector<MuscleStep>& steps, const MuscleCrowd& crowd, MuscleCrowdState& state) {
  if (!crowd.surfaces.pairs.empty()) return couple_by_surfaces(steps, crowd.surfaces, state.surfaces);
  if (!crowd.edges.pairs.empty()) return couple_by_edges(steps, crowd.edges, state.edges);
  return {};
}

/// The first thing after which a coordinate was not finite.
struct Failure {
  std::size_t muscle = 0;
  ConstraintKind kind = ConstraintKind::none;
};

/// Solves again from the prediction and watches.
Failure find_failure(std::vector<SurfaceSolve>& solves, const std::vector<Particles>& predicted,
                     const std::vector<MuscleStep>& steps, const MuscleCrowd& crowd, MuscleCrowdState& crowd_state) {
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i].state->particles = predicted[i];
  std::vector<std::optional<ConstraintKind>> first(steps.size());
  solve_together(solves, couple(steps, crowd, crowd_state), [&](std::size_t i, ConstraintKind kind) {
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

void add_to(MuscleReport& report, const SolveReport& solved, Real correction) {
  report.iterations += solved.iterations;
  report.contacts = solved.contacts;
  report.limited_hinges += solved.limited_hinges;
  report.limited_edges += solved.limited_edges;
  report.skipped_constraints += solved.skipped_constraints;
  report.largest_correction = std::max(report.largest_correction, correction);
  report.milliseconds += solved.milliseconds;
}

/// With `placed`, the surfaces are where coarser copies put them, otherwise where bones and inertia do.
void advance_substep(const std::vector<MuscleStep>& steps, const MuscleCrowd& crowd, MuscleCrowdState& crowd_state,
                     int substeps, const Pose& before, const Pose& now,
                     const std::vector<Particles>* placed = nullptr) {
  std::vector<SurfaceSolve> solves(steps.size());
  std::vector<std::vector<FieldPlacement>> placements(steps.size());
  std::vector<Particles> predicted(steps.size());
  if (!crowd.edges.pairs.empty()) remember_positions(particles_of<const Particles*>(steps), crowd_state.edges);
  if (!crowd.surfaces.pairs.empty()) remember_places(particles_of<const Particles*>(steps), crowd_state.surfaces);
  const VirtualEdgeState edges_before = crowd_state.edges;
  parallel_for_each(steps.size(), [&](std::size_t i) {
    const PreparedMuscle& muscle = *steps[i].muscle;
    MuscleState& state = *steps[i].state;
    solves[i] = {&muscle.system, &placements[i], solve_settings(muscle.settings, substeps), &state, {}};
    solves[i].settings.contraction = static_cast<float>(contraction_strength(muscle.contraction, steps[i].activation));
    placements[i] = place_fields(muscle, now);
    remember_sides(muscle.system, place_fields(muscle, before), state);
    if (placed) {
      solves[i].settings.iterations = muscle.settings.full_iterations;
      place(muscle, steps[i].activation, now, (*placed)[i], state);
      if (solves[i].settings.iterations == 0) refresh_contacts(muscle.system, placements[i], state);
    } else {
      predict(muscle, steps[i].activation, before, now, static_cast<float>(solves[i].settings.time_step), state);
    }
    predicted[i] = state.particles;
  });
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (!is_finite(predicted[i]))
      throw QualityError("muscle " + steps[i].muscle->name +
                         ": a vertex position is not finite before the solver; check the pose and the velocities");
  solve_together(solves, couple(steps, crowd, crowd_state), record_passes(steps, solves));
  const auto is_lost = [](const MuscleStep& step) { return !is_finite(step.state->particles); };
  if (std::any_of(steps.begin(), steps.end(), is_lost)) {
    crowd_state.edges = edges_before;
    forget_touches(crowd_state.surfaces);
    throw_failure(steps, find_failure(solves, predicted, steps, crowd, crowd_state));
  }
  parallel_for_each(steps.size(), [&](std::size_t i) {
    SurfaceState& state = *steps[i].state;
    if (!placed && steps[i].muscle->settings.time_mode == TimeMode::dynamic)
      take_velocities(static_cast<float>(solves[i].settings.time_step), state);
    add_to(*steps[i].report, solves[i].report, static_cast<Real>(largest_motion(predicted[i], state.particles)));
  });
}

/// Adds each pair's counts to both of its muscles.
void report_edges(const VirtualEdgeCrowd& crowd, const VirtualEdgeState& state, const std::vector<MuscleStep>& steps) {
  for (std::size_t i = 0; i < crowd.pairs.size(); ++i)
    for (const Index surface : {crowd.pairs[i].first, crowd.pairs[i].second}) {
      MuscleReport& report = *steps[static_cast<std::size_t>(surface)].report;
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

void advance_together(const std::vector<MuscleStep>& steps, const MuscleCrowd& crowd, MuscleCrowdState& crowd_state,
                      const Pose& before, const Pose& now) {
  std::vector<const PreparedMuscle*> muscles;
  for (const MuscleStep& step : steps) muscles.push_back(step.muscle);
  const std::vector<Pose> poses = substep_poses(muscles, before, now);
  begin_touch_frame(crowd.surfaces, crowd_state.surfaces);
  begin_edge_frame(crowd.edges, particles_of<const Particles*>(steps), crowd_state.edges);
  Pose reached = before;
  for (const Pose& pose : poses) {
    advance_substep(steps, crowd, crowd_state, static_cast<int>(poses.size()), reached, pose);
    reached = pose;
  }
  end_edge_frame(crowd.edges, crowd_state.edges);
  report_edges(crowd.edges, crowd_state.edges, steps);
}

void refine_together(const std::vector<MuscleStep>& steps, const MuscleCrowd& crowd, MuscleCrowdState& crowd_state,
                     const Pose& before, const Pose& now, const std::vector<Particles>& placed) {
  advance_substep(steps, crowd, crowd_state, 1, before, now, &placed);
}

}  // namespace gracilis::xpbd
