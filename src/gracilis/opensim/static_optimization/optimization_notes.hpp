#pragma once

#include <gracilis/opensim/static_optimization/static_optimization.hpp>

#include <string>
#include <vector>

namespace gracilis::opensim {

/// A sentence for each instant at which muscles and actuators are too weak, with the three coordinates that miss most.
std::vector<std::string> weakness_notes(const StaticOptimizationResult& result);

/// Says from when to when the loads were measured, where that is not all the way from `begin` to `end` (s); otherwise
/// empty, as for no loads.
std::string unmeasured_loads_note(const ExternalLoads& loads, Real begin, Real end);

}  // namespace gracilis::opensim
