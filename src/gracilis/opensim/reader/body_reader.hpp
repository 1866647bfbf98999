#pragma once

#include <gracilis/opensim/reader/model_parts.hpp>

namespace gracilis::opensim {

/// Bodies with their geometry, wrap objects and offset frames; the ground first.
void read_bodies(ModelReading& reading, const pugi::xml_node& model);
/// What a node shows at this frame: meshes; other shapes are left out with a remark.
void read_geometry(ModelReading& reading, const pugi::xml_node& node, const PlacedFrame& frame);
/// The offset frames of one set, named from `owner`, with their geometry and wrap objects.
void read_frames(ModelReading& reading, const pugi::xml_node& holder, const char* set, const std::string& owner);

}  // namespace gracilis::opensim
