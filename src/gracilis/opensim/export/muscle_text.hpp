#pragma once

#include <gracilis/opensim/reader/model.hpp>

#include <string>

namespace gracilis::opensim {

/// The muscle as an element of a ForceSet of version 4.0, with its path (points of all kinds and wraps) and parameters.
std::string muscle_text(const Model& model, const Muscle& muscle);

}  // namespace gracilis::opensim
