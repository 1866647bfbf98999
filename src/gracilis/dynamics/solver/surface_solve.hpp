#pragma once

#include <gracilis/dynamics/constraints/tension.hpp>
#include <gracilis/dynamics/contact/surface/untangling.hpp>
#include <gracilis/dynamics/movers.hpp>
#include <gracilis/dynamics/solver/constraint_kind.hpp>
#include <gracilis/dynamics/solver/surface_system.hpp>

#include <cstddef>
#include <functional>
#include <vector>

namespace gracilis {

/// How one substep is solved.
struct SolveSettings {
  int iterations = 30;
  int settling_rounds = 0;          ///< of volume and contact alone after the last iteration
  double time_step = 1.0 / 60;      ///< s
  ProjectionParameters projection;  ///< its time step is that of distances and dihedrals
  TensionLaw tension;               ///< by default tensions are not projected
  double pressure = 1;              ///< target volume over the volume at rest
  float strain_limit = 0;           ///< longest an edge may be, over its length at rest; 0: none
  ShapeLimits shape_limits;         ///< while settling
  float stop_displacement = 0;      ///< m; stop early when no particle moved further in an iteration; 0: never
  double stop_milliseconds = 0;     ///< stop early after this time; 0: never
};

struct SolveReport {
  int iterations = 0;
  Index contacts = 0;           ///< most that were touching in the last iteration or while settling
  Index limited_dihedrals = 0;  ///< sums over all iterations
  Index limited_edges = 0;
  Index skipped_constraints = 0;
  double milliseconds = 0;
};

/// One surface's part in a solve. The state's particles are the prediction on entry and the solution on return.
struct SurfaceSolve {
  const SurfaceSystem* system = nullptr;
  const std::vector<FieldPlacement>* placements = nullptr;
  SolveSettings settings;
  SurfaceState* state = nullptr;
  SolveReport report;
};

/// What acts between surfaces in each iteration; empty functions: nothing. Those not among the movers have not moved
/// since the last look and stay where they are.
struct Coupling {
  std::function<void(const Movers&)> refresh;   ///< looks again at what is near what
  std::function<Index(const Movers&)> project;  ///< returns how many contacts pushed
  /// Of the movers, once they settled, per surface.
  std::function<std::vector<Tangle>(const Movers&)> find_tangles = {};
  std::function<void(const std::vector<Tangle>&, int attempt)> untangle = {};  ///< attempts of a step count from 0
  /// After a refresh: takes what lies deep in another surface out of it; returns which surfaces moved, empty: none.
  std::function<std::vector<char>()> repair_penetrations = {};
};

/// Called after each projection of a kind on a surface.
using SolveTrace = std::function<void(std::size_t surface, ConstraintKind kind)>;

}  // namespace gracilis
