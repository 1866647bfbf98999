#pragma once

#include <gracilis/dynamics/solver/surface_solve.hpp>

#include <vector>

namespace gracilis {

/// Solves a substep of all surfaces in step (XPBD; Macklin, Müller, Chentanez 2016): resets the multipliers, iterates
/// (iteration.hpp), and settles (post_stabilization.hpp); where some cut themselves they are untangled and all settle
/// again; where some still do, those are untangled once more and settle among the others, which stay, but go back
/// where that left no less of a tangle. Last, what lies deep in another surface is taken out of it. Free particles with
/// a fixed neighborhood, coinciding ends and flat triangles are survived; they are counted as skipped.
void solve_together(std::vector<SurfaceSolve>& surfaces, const Coupling& coupling, const SolveTrace& trace = {});

/// The same for one surface alone.
SolveReport solve_substep(const SurfaceSystem& system, const std::vector<FieldPlacement>& placements,
                          const SolveSettings& settings, SurfaceState& state);

}  // namespace gracilis
