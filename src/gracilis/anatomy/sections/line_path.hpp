#pragma once

#include <gracilis/scene/pose.hpp>
#include <gracilis/scene/scene.hpp>

namespace gracilis {

/// Where a muscle's line runs in a pose, at least two points: through those of its path that are there, around the
/// path's surfaces in steps of 5 degrees; without a path, through its points, which move with their bodies. So it does
/// where less than two points of the path are there.
Points line_at(const ActionLine& line, const Pose& pose);

}  // namespace gracilis
