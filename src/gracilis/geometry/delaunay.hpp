#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis {

/// n points in the plane, 2 × n.
using PlanePoints = Eigen::Matrix2Xd;

/// The Delaunay triangulation of points in the plane by incremental insertion (Bowyer 1981, Watson 1981): 3 × m
/// indices, counter-clockwise. O(n²), meant for some hundred points. Points that coincide with earlier ones are left
/// out.
Eigen::Matrix3Xi delaunay(const PlanePoints& points);

/// Whether p lies inside a closed polygon (even-odd rule).
bool inside_polygon(const PlanePoints& polygon, const Eigen::Vector2d& p);

/// Signed area of a closed polygon, positive when counter-clockwise.
Real polygon_area(const PlanePoints& polygon);

/// Whether no two sides of a closed polygon cross. O(n²).
bool is_simple(const PlanePoints& polygon);

/// Distance from p to the nearest side of a closed polygon.
Real distance_to_polygon(const PlanePoints& polygon, const Eigen::Vector2d& p);

}  // namespace gracilis
