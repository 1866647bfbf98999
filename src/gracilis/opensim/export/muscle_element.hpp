#pragma once

#include <gracilis/opensim/reader/model.hpp>
#include <gracilis/opensim/reader/xml.hpp>

#include <string>

namespace gracilis::opensim {

/// The path that a force holds: a GeometryPath below it, or below its `<path>`; may be empty.
pugi::xml_node geometry_path_of(const pugi::xml_node& force);

/// The muscle's element as it stands in its model's file, and what the file's `<defaults>` say beside it: nothing of
/// its curves and controls is lost in a set of forces. Precondition: the file has the muscle.
std::string own_muscle_text(const XmlFile& file, const std::string& muscle);

/// The same along other points, without wrap objects, and with the muscle's tendon slack length. Precondition: the path
/// in the file is a GeometryPath, and `model` was read from the file.
std::string own_muscle_text_along(const XmlFile& file, const Model& model, const Muscle& muscle);

}  // namespace gracilis::opensim
