#pragma once

#include <gracilis/opensim/export/path_fit.hpp>
#include <gracilis/opensim/reader/model.hpp>

#include <filesystem>
#include <string>
#include <vector>

/// What a run found, in forms that OpenSim reads.
namespace gracilis::opensim {

/// A muscle's length as a polynomial of the coordinates that change it.
struct FittedMuscle {
  std::string name;
  std::vector<std::string> coordinates;
  PathFit fit;
};

/// Fits the mean lengths of all muscles' fibers in a run's fiber_lengths.sto. A muscle is fitted over those of the
/// coordinates that vary in the run and that matter to it: leaving one out must make it worse by a tenth. Throws
/// InputError. With the model, only coordinates of joints that the muscle crosses are taken.
std::vector<FittedMuscle> fit_run(const std::filesystem::path& run, const Model* model = nullptr);

/// The set of FunctionBasedPaths as OpenSim 4.5 and later read it, for muscles of a force set.
std::string function_path_set(const std::string& name, const std::vector<FittedMuscle>& muscles);

/// Fits and writes the set; returns a line for each muscle: order, coordinates, error.
std::vector<std::string> export_function_paths(const std::filesystem::path& run, const std::filesystem::path& out,
                                               const Model* model = nullptr);

}  // namespace gracilis::opensim
