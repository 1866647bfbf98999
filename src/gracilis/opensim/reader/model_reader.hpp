#pragma once

#include <gracilis/opensim/reader/model.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis::opensim {

/// Reads an .osim file of document version 1.0 to 4.6 (Delp et al. 2007, Seth et al. 2018). What the file holds and
/// this model cannot express is listed in Model::unsupported and left out. Throws InputError naming file and element:
/// broken XML, joints and couplers whose bodies or coordinates do not exist, joints in a circle, bodies on two joints,
/// axes without length or twice the same, functions whose points do not fit. A force that cannot be read is left out; a
/// model without a name is called as its file.
Model read_model(const std::filesystem::path& path);

/// Adds the forces of a file that holds a ForceSet to the model, or replaces the model's muscles and actuators by them.
/// One of a name that was there before takes its place, which Model::unsupported tells.
void read_force_set(const std::filesystem::path& path, bool replace, Model& model);

}  // namespace gracilis::opensim
