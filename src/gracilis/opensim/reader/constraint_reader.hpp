#pragma once

#include <gracilis/opensim/reader/model_parts.hpp>

namespace gracilis::opensim {

/// Couplers and what closes loops; other constraints are left out, and named. Throws InputError.
void read_constraints(ModelReading& reading, const pugi::xml_node& model);

/// The two frames that an element links: 4.x names them (frame1, frame2, or body_1, body_2 of point constraints), 3.x
/// their bodies and where the frames lie in these.
std::pair<PlacedFrame, PlacedFrame> two_frames(ModelReading& reading, const pugi::xml_node& node);

}  // namespace gracilis::opensim
