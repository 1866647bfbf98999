#pragma once

#include <gracilis/dynamics/solver/constraint_table.hpp>
#include <gracilis/methods/method_entry.hpp>
#include <gracilis/methods/xpbd/motion.hpp>
#include <gracilis/scene/pose.hpp>

#include <memory>
#include <optional>

namespace gracilis::xpbd {

/// A muscle in the middle of a solve, neither at rest nor converged: what timings of a single iteration start from.
struct MidSolveSnapshot {
  PreparedMuscle muscle;
  std::vector<FieldPlacement> placements;
  SolveSettings settings;
  MuscleState state;
};

/// Takes a muscle alone and relaxed through the poses, and stops after three iterations of the last. `fields` (one per
/// bone) must outlive the result; `carrying` are the strings that runs would carry it by (carrying_strings), none: the
/// bodies do. Precondition: at least one pose; the scene is valid.
MidSolveSnapshot mid_solve_snapshot(const Scene& scene, const Muscle& muscle, const std::vector<DistanceField>& fields,
                                    const std::vector<Pose>& poses, const CarryingStrings& carrying = {});

/// Times one projection of all constraints of a kind, or, without a kind, one iteration with all of them: the mean of
/// ten in a row from where the muscle is, the median over `repeats` such rows, each from the same state.
PhaseTime time_projection(const MidSolveSnapshot& muscle, std::optional<ConstraintKind> kind, int repeats);

/// The same for programs that know no constraints, carried as in runs (MethodEntry::phase_timer). A relaxed muscle has
/// no phase of contraction.
std::unique_ptr<PhaseTimer> phase_timer(const Scene& scene, const Muscle& muscle,
                                        const std::vector<DistanceField>& fields,
                                        const std::vector<DistanceField>& far_fields, const std::vector<Pose>& poses);

}  // namespace gracilis::xpbd
