#pragma once

#include <gracilis/opensim/reader/model.hpp>

#include <string>
#include <vector>

namespace gracilis::opensim {

/// A sentence for each thing that the model's files hold and the model leaves out, from entry `first` of
/// Model::unsupported on.
std::vector<std::string> unsupported_notes(const Model& model, std::size_t first = 0);

/// A sentence for each muscle whose path is approximate.
std::vector<std::string> approximate_path_notes(const Model& model);

/// Says which of the model's forces took no part in a computation of forces; empty where all did.
std::string missing_forces_note(const Model& model);

}  // namespace gracilis::opensim
