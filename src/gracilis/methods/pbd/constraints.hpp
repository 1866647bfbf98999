#pragma once

#include <gracilis/core/types.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

/// The constraint functions of position based dynamics as published for muscles (Cervenka and Kohout 2020).
namespace gracilis::pbd {

/// A constraint at one place: C and its gradient by each of its points.
template <std::size_t count>
struct Evaluated {
  Real value = 0;
  std::array<Vec3, count> gradient{};
  bool has_gradient = false;  ///< without one a projection moves nothing
};

/// Eq. 2: C = |b - a| - length, m.
Evaluated<2> distance_constraint(const Vec3& a, const Vec3& b, Real length);

/// The angle of eq. 4, rad in [0, π]: arccos of the product of the normals (b - a) × (c - a) and (b - a) × (d - a); π
/// where the triangles (a, b, c) and (a, d, b) are flat, 0 where they are folded together. π for degenerate triangles.
Real arccos_angle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Eq. 4: C = angle - rest_angle. Which way a dihedral bends is not in its angle, so there is no gradient where it is
/// flat or folded together.
Evaluated<4> angle_constraint(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, Real rest_angle);

/// Eq. 5, with the absolute value that a direction without sense needs: \f$1 - |u \cdot v|\f$, unit; 1 where v is 0.
Real anisotropy(const Vec3& edge_direction, const Vec3& fiber_direction);

/// Moves the points by eq. 1, stiffness s from 0 to 1: \f$\Delta p_i = -s C w_i \nabla_i C / \sum_j w_j |\nabla_j
/// C|^2\f$. `weight` is 0 for points that are held. No point goes farther than `limit`, m; all go the less then. False
/// where it moved nothing for want of a gradient.
template <std::size_t count>
bool project(const Evaluated<count>& constraint, Real stiffness, const std::array<Real, count>& weight,
             const std::array<Vec3*, count>& points, Real limit = std::numeric_limits<Real>::infinity()) {
  if (!constraint.has_gradient) return false;
  Real sum = 0;
  Real longest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    sum += weight[i] * constraint.gradient[i].squaredNorm();
    longest = std::max(longest, weight[i] * constraint.gradient[i].norm());
  }
  if (!(sum > 0)) return false;
  const Real wanted = stiffness * constraint.value / sum, most = limit / longest;
  const Real multiplier = std::clamp(wanted, -most, most);
  for (std::size_t i = 0; i < count; ++i)
    if (weight[i] > 0) *points[i] -= multiplier * weight[i] * constraint.gradient[i];
  return true;
}

}  // namespace gracilis::pbd
