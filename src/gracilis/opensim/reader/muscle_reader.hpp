#pragma once

#include <gracilis/opensim/reader/model_parts.hpp>

namespace gracilis::opensim {

/// Whether a force takes part: 4.x says appliesForce, 3.x isDisabled.
bool applies_force(const XmlContext& context, const pugi::xml_node& node);

/// A muscle with its path and the parameters of its curves. Throws InputError.
Muscle read_muscle(ModelReading& reading, const pugi::xml_node& node);

}  // namespace gracilis::opensim
