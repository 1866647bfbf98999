#pragma once

#include <gracilis/opensim/reader/model_parts.hpp>

namespace gracilis::opensim {

/// Joints and their coordinates, parents before children. A body on no joint gets a free one to the ground.
void read_joints(ModelReading& reading, const pugi::xml_node& model);
/// The three rotation axes, or the three translation axes, made of unit length and independent: those that nothing
/// moves along are chosen to suit. Throws InputError where a moving axis has no length or repeats another.
void complete_axes(const ModelReading& reading, const pugi::xml_node& joint, TransformAxis* axes);

}  // namespace gracilis::opensim
