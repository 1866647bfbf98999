#pragma once

#include <gracilis/core/types.hpp>

#include <vector>

namespace gracilis {

/// s, between two frames where nothing else is said.
inline constexpr Real usual_time_step = 1.0 / 60;

/// Where every body is at one instant.
struct Pose {
  Real time = 0;                       ///< s
  std::vector<Real> coordinates;       ///< rad, in the order of all axes of all joints of the scene
  std::vector<RigidTransform> bodies;  ///< per body: from its place in the capture pose to its place now, world frame
  std::vector<Real> activations = {};  ///< 0 to 1 per muscle of the scene; empty: all muscles are relaxed
};

/// Where all bodies are as they were captured.
inline Pose capture_pose(std::size_t body_count) {
  Pose pose;
  pose.bodies.assign(body_count, RigidTransform::Identity());
  return pose;
}

}  // namespace gracilis
