#include <gracilis/dynamics/solver/solver.hpp>

#include <gracilis/dynamics/solver/iteration.hpp>
#include <gracilis/dynamics/solver/post_stabilization.hpp>

#include <algorithm>

namespace gracilis {

namespace {

constexpr int untangling_attempts = 3;

bool is_tangled(const Tangle& tangle) { return !tangle.pairs.empty(); }

bool any_tangled(const std::vector<Tangle>& tangles) { return std::any_of(tangles.begin(), tangles.end(), is_tangled); }

bool settles(const SurfaceSolve& surface) { return surface.settings.settling_rounds > 0; }

/// Once more those that are still tangled, among the others, which stay; one that is tangled no less by that goes back.
/// Returns what is left.
std::vector<Tangle> untangle_again(JointSolve& solve, const std::vector<Tangle>& tangles, int attempt) {
  std::vector<Particles> before(tangles.size());
  solve.movers.listed.assign(tangles.size(), 0);
  for (std::size_t i = 0; i < tangles.size(); ++i)
    if (is_tangled(tangles[i])) solve.movers.listed[i] = 1, before[i] = solve.surfaces[i].state->particles;
  solve.coupling.untangle(tangles, attempt);
  settle(solve);
  std::vector<Tangle> left = solve.coupling.find_tangles(solve.movers);
  for (std::size_t i = 0; i < tangles.size(); ++i)
    if (solve.movers.move(i) && !is_less(left[i], tangles[i]))
      solve.surfaces[i].state->particles = std::move(before[i]), left[i] = tangles[i];
  return left;
}

/// Twice towards its shape at rest: what is crushed may resist, and each attempt takes it away from its shape now, so
/// that with more of them it cuts itself the more in the steps that follow. A third time towards the prediction.
void untangle(JointSolve& solve) {
  if (!solve.coupling.find_tangles) return;
  const std::vector<Tangle> tangles = solve.coupling.find_tangles(solve.movers);
  if (!any_tangled(tangles)) return;
  solve.coupling.untangle(tangles, 0);
  settle(solve);  // all of them: they give way to what was untangled
  std::vector<Tangle> left = solve.coupling.find_tangles(solve.movers);
  for (int attempt = 1; attempt < untangling_attempts && any_tangled(left); ++attempt)
    left = untangle_again(solve, left, attempt);
}

}  // namespace

void solve_together(std::vector<SurfaceSolve>& surfaces, const Coupling& coupling, const SolveTrace& trace) {
  JointSolve solve(surfaces, coupling, trace);
  iterate(solve);
  if (std::none_of(surfaces.begin(), surfaces.end(), settles)) return;
  settle(solve);
  untangle(solve);
  recover(solve);
  repair(solve);
}

SolveReport solve_substep(const SurfaceSystem& system, const std::vector<FieldPlacement>& placements,
                          const SolveSettings& settings, SurfaceState& state) {
  std::vector<SurfaceSolve> alone = {{&system, &placements, settings, &state, {}}};
  solve_together(alone, {});
  return alone.front().report;
}

}  // namespace gracilis
