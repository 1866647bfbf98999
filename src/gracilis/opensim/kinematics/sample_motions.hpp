#pragma once

#include <gracilis/opensim/kinematics/coordinate_motion.hpp>

namespace gracilis::opensim {

/// Motions that fill the space of a joint's coordinates, for samples of activations or moment arms.
struct SampleMotion {
  std::string name;  ///< JOINT_COORDINATE, or JOINT_combined
  CoordinateMotion motion;
};

/// For every angle of the joint that is neither locked nor dependent: from one end of its range to the other in `steps`
/// equal steps, the others at their default values; and where there are several, all combinations of these values, such
/// that from row to row one coordinate changes by one step. Rows are 0.01 s apart. `steps` from 1 on; throws
/// ConfigurationError for more than 1,000,000 combinations. Empty for a joint without such angles.
std::vector<SampleMotion> sample_motions(const Model& model, const Joint& joint, int steps);

}  // namespace gracilis::opensim
