#pragma once

#include <gracilis/opensim/reader/model_parts.hpp>

namespace gracilis::opensim {

/// Puts joints whose parents are nearer to the ground first. A joint to a body that one before it in the file holds
/// closes a loop, as OpenSim has it (Simbody's MultibodyGraphMaker): it moves a copy of the body without mass, which is
/// welded to it; one without coordinates becomes a weld itself. This is told. Throws InputError for a joint that moves
/// the ground, and for a circle of joints that never meets it.
void sort_joints(ModelReading& reading, const pugi::xml_node& model);

}  // namespace gracilis::opensim
