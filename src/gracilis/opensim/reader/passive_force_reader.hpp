#pragma once

#include <gracilis/opensim/reader/model_parts.hpp>

namespace gracilis::opensim {

/// Whether a force of this kind is a passive one that is known.
bool is_passive_force(const pugi::xml_node& node);
/// Precondition: is_passive_force(node).
PassiveForce read_passive_force(ModelReading& reading, const pugi::xml_node& node);

}  // namespace gracilis::opensim
