#include <gracilis/dynamics/solver/iteration.hpp>

#include <gracilis/dynamics/solver/bone_contact.hpp>
#include <gracilis/dynamics/solver/constraint_table.hpp>

#include <algorithm>

namespace gracilis {

namespace {

/// Iterations between two looks at whether particles moved so far that something may have come near a bone.
constexpr int motion_check = 4;
/// Iterations between two looks at what is near between surfaces, which walk and list with reserve.
constexpr int coupling_refresh = 15;

/// Where contact settles after the last iteration it is projected in every other one, and what comes after it, but for
/// so many at the end: the shapes are as good, and contact takes most of an iteration's time. A muscle that contracts
/// would be pulled into what it touches and out again, and small differences would grow.
constexpr int contact_period = 2, last_with_contact = 8;

bool projects_contact(const SurfaceSolve& surface, int iteration) {
  const SolveSettings& settings = surface.settings;
  const bool settles = settings.settling_rounds > 0;
  const bool contracts = settings.tension.strength > 0 && !surface.system->tensions.a.empty();
  return !settles || contracts || iteration % contact_period == 1 ||
         iteration + last_with_contact >= settings.iterations;
}

/// Where one surface stands in its iterations.
struct Progress {
  bool last = false, done = false;
  Particles before;
};

void project_phase(ConstraintPhase phase, JointSolve& solve, std::size_t i) {
  const SurfaceSolve& surface = solve.surfaces[i];
  const bool with_contact = projects_contact(surface, surface.report.iterations);
  for (const ConstraintRow& row : constraint_table()) {
    if (row.phase != phase || (phase == ConstraintPhase::after_contact && !with_contact)) continue;
    row.project(solve.surfaces[i]);
    solve.tell(i, row.kind);
  }
}

/// All of an iteration up to contact between surfaces.
void begin_iteration(JointSolve& solve, std::size_t i, double elapsed, Progress& progress) {
  const SurfaceSolve& surface = solve.surfaces[i];
  const SolveSettings& settings = surface.settings;
  const int iteration = surface.report.iterations;
  if (settings.stop_displacement > 0) progress.before = surface.state->particles;
  progress.last =
      iteration + 1 >= settings.iterations || (settings.stop_milliseconds > 0 && elapsed > settings.stop_milliseconds);
  if (iteration == 0)
    refresh_contacts(*surface.system, *surface.placements, *surface.state);
  else if (iteration % motion_check == 0)
    keep_listed(*surface.system, *surface.placements, *surface.state);
  project_phase(ConstraintPhase::before_contact, solve, i);
}

/// What comes after contact between surfaces.
void end_iteration(JointSolve& solve, std::size_t i, Progress& progress) {
  SurfaceSolve& surface = solve.surfaces[i];
  if (progress.last) keep_listed(*surface.system, *surface.placements, *surface.state);
  project_phase(ConstraintPhase::after_contact, solve, i);
  ++surface.report.iterations;
  const float least = surface.settings.stop_displacement;
  progress.done = progress.last || (least > 0 && largest_motion(progress.before, surface.state->particles) < least);
}

}  // namespace

void iterate(JointSolve& solve) {
  std::vector<Progress> progress(solve.surfaces.size());
  for (std::size_t i = 0; i < progress.size(); ++i) progress[i].done = solve.surfaces[i].settings.iterations <= 0;
  const auto is_active = [&](std::size_t i) { return !progress[i].done; };
  const auto is_done = [](const Progress& each) { return each.done; };
  for (int iteration = 0;; ++iteration) {
    const double elapsed = solve.elapsed();
    // The end of one iteration and the begin of the next at one go, while the surface is in the cache.
    solve.for_each(is_active, [&](std::size_t i) {
      if (iteration > 0) end_iteration(solve, i, progress[i]);
      if (!progress[i].done) begin_iteration(solve, i, elapsed, progress[i]);
    });
    if (std::all_of(progress.begin(), progress.end(), is_done)) return;
    if (solve.coupling.project && iteration % coupling_refresh == 0) solve.coupling.refresh(solve.movers);
    bool any_touches = false;
    for (std::size_t i = 0; i < progress.size(); ++i)
      any_touches |= !progress[i].done && projects_contact(solve.surfaces[i], iteration);
    if (any_touches) solve.project_contact();
  }
}

}  // namespace gracilis
