#pragma once

#include <gracilis/opensim/reader/model_parts.hpp>

namespace gracilis::opensim {

void read_wrap_objects(ModelReading& reading, const pugi::xml_node& holder, const PlacedFrame& frame);
Path read_path(ModelReading& reading, const pugi::xml_node& force);

}  // namespace gracilis::opensim
