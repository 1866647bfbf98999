#pragma once

#include <gracilis/geometry/field_path.hpp>

#include <array>

namespace gracilis {

/// A corner of an edge or face in the obstacle's frame, with the gap that it must keep.
struct ContactCorner {
  Eigen::Vector3f q;
  float gap = 0;
};

/// The share of an edge at an end of this inverse mass that is not tested: at a fixed end nothing can be pushed out
/// without throwing the other end far away.
inline float lowest_share(float inverse_mass) { return inverse_mass > 0 ? 0 : 0.2f; }

/// Of an edge that was this far above its gap at its deepest point, other points were, too, m.
inline constexpr float edge_reserve = 0.0005f;

/// Where between 0 (a) and 1 (b) the edge is deepest below the line between its gaps: bisection by the slope along the
/// edge, four samples, within [low, high]. A local minimum where the obstacle is not convex.
float deepest_on_edge(const FieldGrid& field, const ContactCorner& a, const ContactCorner& b, float low, float high);

/// Barycentric coordinates of the deepest point of a triangle: six Frank-Wolfe steps from its center (Macklin et al.
/// 2020). A local minimum where the obstacle is not convex.
Eigen::Vector3f deepest_on_face(const FieldGrid& field, const std::array<ContactCorner, 3>& corners);

}  // namespace gracilis
