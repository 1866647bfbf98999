#pragma once

#include <gracilis/opensim/reader/model.hpp>

#include <string>

namespace gracilis::opensim {

/// The muscle as an element of a ForceSet of the model's version, with its path (points of all kinds and wraps) and its
/// first parameters: for muscles that stand in no file (muscle_element).
std::string muscle_text(const Model& model, const Muscle& muscle);

/// The points of its path alone, a PathPointSet.
std::string point_set_text(const Model& model, const Path& path);

}  // namespace gracilis::opensim
