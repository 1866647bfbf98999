#pragma once

#include <gracilis/methods/method_entry.hpp>

#include <vector>

namespace gracilis::xpbd {

/// What the solver counted for one muscle in one frame.
struct StepCounts {
  int iterations = 0;
  Index triangles = 0;            ///< of the surface that was simulated
  Real largest_correction = 0;    ///< m, farthest that the solver moved a vertex from where it was predicted
  Index contacts = 0;             ///< points touching a bone at the end
  Index limited_dihedrals = 0;    ///< dihedral projections held back, over all iterations
  Index limited_edges = 0;        ///< edges held at the stretch limit, over all iterations
  Index skipped_constraints = 0;  ///< projections without a usable gradient, over all iterations
  Index virtual_edges = 0;        ///< between this muscle and others; 0 where contact is not by virtual edges
  Index virtual_pushes = 0;       ///< of these, pushed apart in the last iteration
  Index coinciding_edges = 0;     ///< of these, on the same vertices as another at the end
  Real milliseconds = 0;
};

/// The columns that the counts are told in.
std::vector<MetricInfo> step_metrics();

/// The counts as these columns.
MuscleReport report_of(const StepCounts& counts);

}  // namespace gracilis::xpbd
