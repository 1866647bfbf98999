#include <gracilis/dynamics/solver/joint_solve.hpp>

namespace gracilis {

JointSolve::JointSolve(std::vector<SurfaceSolve>& surfaces_, const Coupling& coupling_, const SolveTrace& trace)
    : surfaces(surfaces_), coupling(coupling_), trace_(trace) {
  for (SurfaceSolve& surface : surfaces) {
    reset_multipliers(*surface.state);
    surface.report = {};
  }
}

void JointSolve::project_contact() {
  if (!coupling.project) return;
  const Clock::time_point started = Clock::now();
  coupling.project(movers);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    tell(i, ConstraintKind::muscle_contact);
    surfaces[i].report.milliseconds += milliseconds_since(started) / static_cast<double>(surfaces.size());
  }
}

}  // namespace gracilis
