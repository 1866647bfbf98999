#pragma once

#include <gracilis/opensim/reader/model_parts.hpp>

namespace gracilis::opensim {

/// The wrap objects of a body or frame; kinds that are not known are left out with a remark.
void read_wrap_objects(ModelReading& reading, const pugi::xml_node& holder, const PlacedFrame& frame);
/// The path of a force: by points or by functions. Throws InputError where it has none.
Path read_path(ModelReading& reading, const pugi::xml_node& force);

}  // namespace gracilis::opensim
