#pragma once

#include <gracilis/opensim/reader/model.hpp>

#include <filesystem>

namespace gracilis::opensim {

/// Puts the paths of a set that `function_path_set` wrote in the place of the model's, as OpenSim's
/// ModOpReplacePathsWithFunctionBasedPaths does. Throws InputError where OpenSim would: another root, a force or
/// coordinate that is not there by this path, no coordinates, a function of another number of arguments, an order below
/// 1, another number of coefficients.
void replace_paths(const std::filesystem::path& set, Model& model);

}  // namespace gracilis::opensim
