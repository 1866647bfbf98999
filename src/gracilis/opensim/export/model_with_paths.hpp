#pragma once

#include <gracilis/opensim/reader/model.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis::opensim {

/// The text of a model's file with these muscles' points, without wrap objects, and tendons' slack lengths in the place
/// of its own; all else stays as it was written. Precondition: `model` was read from the file and has the muscles.
/// Throws InputError where the file is of a version below 3.0 or a muscle's path in it is no GeometryPath.
std::string model_with_paths(const std::filesystem::path& file, const Model& model, const std::vector<Muscle>& muscles);

}  // namespace gracilis::opensim
