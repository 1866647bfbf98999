#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis {

/// Signed dihedral angle in double precision, rad in (-π, π], 0 when flat: the edge runs from x0 to x1, x2 is the apex
/// of the triangle on its left, x3 of that on its right. 0 for degenerate triangles. The formula is that of the hinge
/// kernel.
inline Real dihedral_angle(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3) {
  const Vec3 e = x1 - x0, n1 = e.cross(x2 - x0), n2 = (x3 - x0).cross(e);
  const Real length = e.norm();
  return length > 0 ? std::atan2(n1.cross(n2).dot(e) / length, n1.dot(n2)) : 0;
}

}  // namespace gracilis
