#pragma once

#include <gracilis/strings/relaxation.hpp>

namespace gracilis::strings {

/// The fibers as their strings carry them, and how the muscle has turned about each node.
struct FiberFrames {
  Points fibers;           ///< nodes, world, m
  Eigen::Matrix4Xd turns;  ///< unit quaternions (x, y, z, w) per node, from the capture pose
};

/// Frames that turn as little as possible along each string (Bishop 1975), from the body of its origin to that of its
/// insertion, whose twist is shared out evenly; the ends are the bodies' own. A fiber keeps its offset from its string
/// in them, so in the capture pose it is itself.
FiberFrames fiber_frames(const MuscleStrings& muscle, const StringState& state);

}  // namespace gracilis::strings
