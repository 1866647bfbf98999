#pragma once

#include <gracilis/opensim/kinematics/coordinate_motion.hpp>
#include <gracilis/opensim/kinematics/external_loads.hpp>

#include <string>
#include <vector>

namespace gracilis::opensim {

/// What OpenSim's JointReaction asks for. One entry of `on` and `in` holds for all joints.
struct ReactionSettings {
  std::vector<std::string> joints = {"ALL"};
  std::vector<std::string> on = {"child"};   ///< child or parent: the body that the load is on
  std::vector<std::string> in = {"ground"};  ///< child, parent or a body's name: the axes and the point's frame
};

/// The forces and moments that joints put on bodies in rows of a motion, and the points (the origin of the joint's
/// frame on that body) that moments are about: nine columns a joint, named as OpenSim's JointReaction does
/// (JOINT_on_BODY_in_FRAME_fx ... _pz), N, N·m and m. What bodies need to move so (Newton and Euler) less loads,
/// passive forces and those of muscles and actuators, summed from the last bodies to the first. Moments hold those of
/// actuators and limits on coordinates, too, as OpenSim's do. `forces`: N or N·m over time, a column for each muscle
/// and actuator that applies force, straight between rows. Loops take what the others leave, as little as that needs.
/// Throws InputError: a column is missing, joints or frames are not there.
Table joint_reactions(const Model& model, const CoordinateMotion& motion, const ExternalLoads& loads,
                      const std::vector<std::size_t>& rows, const Table& forces, const ReactionSettings& settings);

}  // namespace gracilis::opensim
