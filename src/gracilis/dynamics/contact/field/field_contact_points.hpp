#pragma once

#include <gracilis/geometry/field_path.hpp>

#include <array>

namespace gracilis {

/// A corner of a face in the obstacle's frame, with the gap that it must keep.
struct ContactCorner {
  Eigen::Vector3f q;
  float gap = 0;
};

/// Barycentric coordinates of the deepest point of a triangle: six Frank-Wolfe steps from its center (Macklin et al.
/// 2020). A local minimum where the obstacle is not convex.
Eigen::Vector3f deepest_on_face(const FieldGrid& field, const std::array<ContactCorner, 3>& corners);

/// The deepest point of the part of a face that is tested, barycentric: all but a share at the corners that cannot
/// move. `movable` has a one for each corner that can move, else a zero, and sums to more than 0.
Eigen::Vector3f deepest_tested(const FieldGrid& grid, const std::array<ContactCorner, 3>& corners,
                               const Eigen::Vector3f& movable, float untested);

}  // namespace gracilis
