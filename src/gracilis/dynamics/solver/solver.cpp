#include <gracilis/dynamics/solver/solver.hpp>

#include <gracilis/dynamics/solver/iteration.hpp>
#include <gracilis/dynamics/solver/post_stabilization.hpp>

#include <algorithm>

namespace gracilis {

namespace {

/// Most attempts at untangling what cannot stay; what is crushed may resist them all, and each takes it away from its
/// shape, so that with more of them it cuts itself the more in the steps that follow.
constexpr int untangling_attempts = 2;

bool settles(const SurfaceSolve& surface) { return surface.settings.settling_rounds > 0; }

/// Whether anything was untangled and has to settle again.
bool untangle(JointSolve& solve, int attempt) {
  return solve.coupling.untangle && solve.coupling.untangle(attempt, solve.movers);
}

}  // namespace

void solve_together(std::vector<SurfaceSolve>& surfaces, const Coupling& coupling, const SolveTrace& trace) {
  JointSolve solve(surfaces, coupling, trace);
  iterate(solve);
  if (std::none_of(surfaces.begin(), surfaces.end(), settles)) return;
  settle(solve);
  for (int attempt = 0; attempt < untangling_attempts && untangle(solve, attempt); ++attempt) {
    if (attempt == 0) solve.movers = {};  // at first all give way to what was untangled
    settle(solve);
  }
  recover(solve);
}

SolveReport solve_substep(const SurfaceSystem& system, const std::vector<FieldPlacement>& placements,
                          const SolveSettings& settings, SurfaceState& state) {
  std::vector<SurfaceSolve> alone = {{&system, &placements, settings, &state, {}}};
  solve_together(alone, {});
  return alone.front().report;
}

}  // namespace gracilis
