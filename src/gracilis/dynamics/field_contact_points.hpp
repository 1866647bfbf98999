#pragma once

#include <gracilis/geometry/field_path.hpp>

#include <array>

namespace gracilis {

/// A corner of an edge or face in the obstacle's frame, with the gap that it must keep.
struct ContactCorner {
  Eigen::Vector3f q;
  float gap = 0;
};

/// Where between 0 (a) and 1 (b) the edge is deepest below the line between its gaps: bisection by the slope along the
/// edge, four samples, within [low, high]. A local minimum where the obstacle is not convex.
float deepest_on_edge(const FieldGrid& field, const ContactCorner& a, const ContactCorner& b, float low, float high);

/// Barycentric coordinates of the deepest point of a triangle: six Frank-Wolfe steps from its center (Macklin et al.
/// 2020). A local minimum where the obstacle is not convex.
Eigen::Vector3f deepest_on_face(const FieldGrid& field, const std::array<ContactCorner, 3>& corners);

}  // namespace gracilis
