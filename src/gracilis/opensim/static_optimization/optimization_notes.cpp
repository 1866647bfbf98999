#include <gracilis/opensim/static_optimization/optimization_notes.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace gracilis::opensim {

std::vector<std::string> weakness_notes(const StaticOptimizationResult& result) {
  std::vector<std::string> notes;
  for (const InfeasibleInstant& instant : result.infeasible) {
    std::string missing;
    for (std::size_t i = 0; i < std::min<std::size_t>(instant.missing.size(), 3); ++i)
      missing += fmt::format("{}{} {:.3g}", i ? ", " : "", instant.missing[i].first, instant.missing[i].second);
    notes.push_back(
        fmt::format("at {} s the muscles and actuators are too weak; missing (N m or N): {}", instant.time, missing));
  }
  return notes;
}

std::string unmeasured_loads_note(const ExternalLoads& loads, Real begin, Real end) {
  if (loads.forces.empty() || (begin >= loads.begin && end <= loads.end)) return {};
  return fmt::format("the loads are measured from {} to {} s only", loads.begin, loads.end);
}

}  // namespace gracilis::opensim
