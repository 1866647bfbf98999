#pragma once

#include <gracilis/opensim/reader/model_parts.hpp>

namespace gracilis::opensim {

/// Muscles, actuators and passive forces below `<set><objects>`. One that cannot be read is left out, and named.
void read_forces(ModelReading& reading, const pugi::xml_node& holder, const char* set);

}  // namespace gracilis::opensim
