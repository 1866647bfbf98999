#pragma once

#include <gracilis/opensim/export/fit_muscles.hpp>

#include <string>
#include <vector>

/// What a run found, in forms that OpenSim reads.
namespace gracilis::opensim {

/// The set of FunctionBasedPaths as OpenSim 4.5 and later write and read it (Set_FunctionBasedPath_), for muscles of a
/// force set: component paths of forces and coordinates, coefficients in ascending powers from the last coordinate on.
std::string function_path_set(const Model& model, const std::vector<FittedMuscle>& muscles);

/// A line that says how well a muscle was fitted: lengths and arms by the same statistic, on poses held out.
std::string fit_line(const Model& model, const FittedMuscle& muscle);

/// One line for all of them: medians over muscles and the worst of them.
std::string fit_summary(const Model& model, const std::vector<FittedMuscle>& muscles);

}  // namespace gracilis::opensim
