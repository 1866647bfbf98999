#pragma once

#include <gracilis/anatomy/builtin/builtin_muscles.hpp>

#include <string>
#include <vector>

namespace gracilis::builtin_hip_shapes {

/// The plans in the order in which the muscles are made: deep ones first, the others make room for them.
std::vector<builtin_shapes::MusclePlan> hip_muscle_plans();

/// Volume of the muscle `name` (without side) in a person of this height (m) and mass (kg), m³: the regression of
/// Handsfield et al. 2014 (tables 2 and 3), volume = b1 (47 height mass + 1285) + b2 in cm³. Precondition: one of the
/// six built-in muscles.
Real literature_volume(const std::string& name, Real height, Real mass);

}  // namespace gracilis::builtin_hip_shapes
