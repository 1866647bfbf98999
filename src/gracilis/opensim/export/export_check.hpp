#pragma once

#include <gracilis/opensim/static_optimization/setup_reader.hpp>

#include <string>
#include <vector>

namespace gracilis::opensim {

/// What exported paths do to static optimization.
struct ExportCheck {
  /// Per muscle the root mean square over instants of the activation with the exported path less that with its own; the
  /// largest first.
  std::vector<std::pair<std::string, Real>> differences;
  std::size_t instants = 0;
  std::size_t infeasible_before = 0, infeasible_after = 0;  ///< instants at which the muscles were too weak
};

/// Solves the set-up (its motion, loads, force sets and times) with both models, which differ in their muscles' paths
/// alone; the set-up's own model is not looked at. Throws InputError; ConfigurationError where the set-up names no
/// motion or no row lies between its times.
ExportCheck check_export(const Model& before, const Model& after, const StaticOptimizationSetup& setup);

/// What the check found, a line for each muscle beyond `bar` and one for all.
std::vector<std::string> check_lines(const ExportCheck& check, Real bar = 0.02);

}  // namespace gracilis::opensim
