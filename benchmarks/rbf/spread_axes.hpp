#pragma once

#include <gracilis/geometry/principal_axes.hpp>

namespace gracilis {

/// Directions of most, less and least spread of points, as columns.
inline Eigen::Matrix3d spread_axes(const Points& points) { return spread_of(points).directions.rowwise().reverse(); }

}  // namespace gracilis
