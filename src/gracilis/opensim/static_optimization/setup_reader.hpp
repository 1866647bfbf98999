#pragma once

#include <gracilis/opensim/static_optimization/joint_reactions.hpp>
#include <gracilis/opensim/static_optimization/static_optimization.hpp>

#include <filesystem>
#include <optional>

namespace gracilis::opensim {

/// What a JointReaction among the analyses asks for.
struct ReactionSetup {
  std::string name = "JointReaction";
  std::filesystem::path forces;  ///< of muscles and actuators; empty: those of static optimization
  ReactionSettings settings;
};

/// What OpenSim's AnalyzeTool file asks of static optimization and joint reactions. Files lie beside the set-up; those
/// not named are empty.
struct StaticOptimizationSetup {
  std::string name = "gracilis";  ///< start of the results' names
  std::string analysis = "StaticOptimization";
  std::filesystem::path model, coordinates, external_loads, results;
  std::vector<std::filesystem::path> force_sets;
  bool replace_force_set = false;
  Real begin = -std::numeric_limits<Real>::infinity(), end = std::numeric_limits<Real>::infinity();  ///< s
  int step_interval = 1;  ///< every so many rows of the coordinates
  Real cutoff = -1;       ///< Hz, of the coordinates' low-pass filter; negative: none
  bool optimizes = true;  ///< false: joint reactions alone, from forces in a file
  StaticOptimizationSettings settings;
  std::optional<ReactionSetup> reactions;
  std::vector<std::string> notes;  ///< what the file asks for beside that, a sentence each
};

/// Throws InputError where the file is no AnalyzeTool or has neither a StaticOptimization among its analyses nor a
/// JointReaction with a file of forces.
StaticOptimizationSetup read_setup(const std::filesystem::path& path);

/// Rows between the set-up's times: the first, every step_interval-th after it, and the last.
std::vector<std::size_t> rows_of(const StaticOptimizationSetup& setup, const std::vector<Real>& times);

}  // namespace gracilis::opensim
