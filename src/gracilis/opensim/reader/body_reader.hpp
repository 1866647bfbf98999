#pragma once

#include <gracilis/opensim/reader/model_parts.hpp>

namespace gracilis::opensim {

/// Bodies with their geometry, wrap objects and offset frames; the ground first.
void read_bodies(ModelReading& reading, const pugi::xml_node& model);
void read_geometry(ModelReading& reading, const pugi::xml_node& node, const PlacedFrame& frame);
void read_frames(ModelReading& reading, const pugi::xml_node& holder, const char* set, const std::string& owner);

}  // namespace gracilis::opensim
