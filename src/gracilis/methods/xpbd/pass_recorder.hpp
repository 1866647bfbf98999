#pragma once

#include <gracilis/dynamics/solver/surface_solve.hpp>
#include <gracilis/methods/pass_tracing.hpp>
#include <gracilis/methods/xpbd/step.hpp>

#include <vector>

namespace gracilis::xpbd {

/// Compares where particles are after each pass of a solve with where they were before, and tells whoever watches the
/// steps; nothing, and at no cost, where nobody does. Steps and solves must outlive the solve.
SolveTrace record_passes(const std::vector<MuscleStep>& steps, const std::vector<SurfaceSolve>& solves);

}  // namespace gracilis::xpbd
