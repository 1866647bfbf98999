#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/polylines.hpp>
#include <gracilis/scene/pose.hpp>

#include <vector>

namespace gracilis {

/// One muscle's shape at one instant.
struct MuscleShape {
  Points points;  ///< 3 × n, m, the muscle's surface vertices in the scene's order
  /// 3 × n, m/s: what a method carries into the next frame, beyond the motion of the bones; empty where it carries
  /// none.
  Points velocities = Points(3, 0);
  /// The muscle's fibers from origin to insertion, as many in every frame, where the method itself knows where they
  /// run; empty: they follow the surface.
  Polylines fibers = {};
  /// Pa, per vertex: the tension of the fibers there over their section at rest; empty where the method knows none.
  Eigen::VectorXd fiber_stresses = {};
};

/// Everything a method reports for one instant.
struct Frame {
  int number = 0;  ///< 0 is the capture pose
  Pose pose;
  std::vector<MuscleShape> muscles;  ///< in the scene's order
};

}  // namespace gracilis
