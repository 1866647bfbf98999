#pragma once

#include <gracilis/opensim/kinematics/coordinate_motion.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace gracilis::opensim {

/// Motions that fill the space of a joint's coordinates, for samples of activations or moment arms.
struct SampleMotion {
  std::string name;  ///< JOINT_COORDINATE, or JOINT_combined
  CoordinateMotion motion;
};

/// Which poses of several coordinates together: all combinations of their steps, such that from one to the next one
/// coordinate changes by one step; or so many poses of Halton's sequence or of a Latin hypercube, ordered so that the
/// next is near; or none.
enum class CombinedPoses { none, grid, halton, latin };

struct SampleSettings {
  int steps = 8;                                        ///< from one end of a range to the other
  std::map<std::string, std::pair<Real, Real>> ranges;  ///< rad, of coordinates by their names; others: the model's
  Real time_step = 0.01;                                ///< s, between rows
  Real speed = radians(30);                             ///< rad/s, the largest of any angle; 0: a row is the next pose
  CombinedPoses combined = CombinedPoses::grid;
  Index samples = 200;  ///< of Halton's sequence or a Latin hypercube
  std::uint64_t seed = 1;
};

/// For every angle of the joint that is neither locked nor dependent: from one end of its range to the other in equal
/// steps, the others at their default values; and where there are several, combined poses. From pose to pose angles go
/// along `10 t³ - 15 t⁴ + 6 t⁵` (Flash and Hogan 1985), so that each pose is reached at rest, and rows are a time step
/// apart. Throws ConfigurationError for more than 1,000,000 poses or rows. Empty for a joint without such angles.
std::vector<SampleMotion> sample_motions(const Model& model, const Joint& joint, const SampleSettings& settings);

}  // namespace gracilis::opensim
