#pragma once

#include <gracilis/core/types.hpp>

#include <vector>

namespace gracilis {

/// Where every body is at one instant.
struct Pose {
  Real time = 0;                         ///< s
  std::vector<Real> coordinates;         ///< rad, in the order of all axes of all joints of the scene
  std::vector<RigidTransform> bodies;    ///< per body: from its place in the capture pose to its place now, world frame
  std::vector<Real> activations = {};    ///< 0 to 1 per muscle of the scene; empty: all muscles are relaxed
};

}  // namespace gracilis
