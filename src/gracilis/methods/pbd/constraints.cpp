#include <gracilis/methods/pbd/constraints.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::pbd {

namespace {

/// Shorter edges, m, and smaller triangles, m², have no direction.
constexpr Real shortest = 1e-12, smallest = 1e-18;
/// Sine of an angle below which nothing tells which way a dihedral bends.
constexpr Real flattest = 1e-6;

}  // namespace

Evaluated<2> distance_constraint(const Vec3& a, const Vec3& b, Real length) {
  const Vec3 along = b - a;
  const Real now = along.norm();
  if (!(now > shortest)) return {-length, {}, false};
  return {now - length, {Vec3(-along / now), Vec3(along / now)}, true};
}

Real arccos_angle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 e = b - a, n1 = e.cross(c - a), n2 = e.cross(d - a);
  const Real lengths = n1.norm() * n2.norm();
  return lengths > 0 ? std::acos(std::clamp(n1.dot(n2) / lengths, Real{-1}, Real{1})) : pi;
}

Evaluated<4> angle_constraint(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, Real rest_angle) {
  Evaluated<4> result;
  result.value = arccos_angle(a, b, c, d) - rest_angle;
  const Vec3 e = b - a, n1 = e.cross(c - a), n2 = e.cross(d - a);
  const Real length = e.norm(), n1_norm2 = n1.squaredNorm(), n2_norm2 = n2.squaredNorm();
  if (!(length > shortest) || !(n1_norm2 > smallest * smallest) || !(n2_norm2 > smallest * smallest)) return result;
  // The derivative of arccos in its stable form: each apex turns about the edge, towards the other or away from it.
  const Real sine = n1.cross(n2).dot(e) / (length * std::sqrt(n1_norm2 * n2_norm2));
  if (std::abs(sine) < flattest) return result;
  const Real side = sine > 0 ? 1 : -1;
  const Vec3 by_c = -side * length / n1_norm2 * n1, by_d = side * length / n2_norm2 * n2;
  const Real c_along = (c - a).dot(e) / (length * length), d_along = (d - a).dot(e) / (length * length);
  result.gradient = {Vec3(-(1 - c_along) * by_c - (1 - d_along) * by_d), Vec3(-c_along * by_c - d_along * by_d), by_c,
                     by_d};
  result.has_gradient = true;
  return result;
}

Real anisotropy(const Vec3& edge_direction, const Vec3& fiber_direction) {
  return std::max(1 - std::abs(edge_direction.dot(fiber_direction)), Real{0});
}

}  // namespace gracilis::pbd
