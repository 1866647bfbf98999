#pragma once

#include <gracilis/methods/tissue/material.hpp>

#include <cmath>

namespace gracilis::tissue {

/// Energy of a point (J) and its derivative by the point's place (N).
struct PointState {
  Real energy = 0;
  Vec3 gradient = Vec3::Zero();
};

/// A spring to a place. `offset`: from that place to the point, m; `stiffness` N/m.
inline PointState spring(const Vec3& offset, Real stiffness) {
  return {stiffness / 2 * offset.squaredNorm(), stiffness * offset};
}

/// Fascia that ties a point to a place across the unit direction `along` and lets it glide along that. Yields: pulls by
/// \f$k e / \sqrt{1 + (e / y)^2}\f$, k the stiffness, where the point is e (m) off and y is `yield`.
inline PointState tie(const Vec3& offset, const Vec3& along, Real stiffness, Real yield) {
  const Vec3 e = offset - along.dot(offset) * along;
  const Real root = std::sqrt(1 + e.squaredNorm() / (yield * yield));
  return {stiffness * yield * yield * (root - 1), stiffness / root * e};
}

/// Keeps a point `gap` (m) away from a surface whose distance is `distance`, with gradient `normal`.
inline PointState contact(Real distance, const Vec3& normal, Real gap, Real stiffness) {
  const Real depth = gap - distance;
  if (!(depth > 0)) return {};
  return {stiffness / 2 * depth * depth, -stiffness * depth * normal};
}

/// Second derivatives, N/m. The surface of a contact counts as flat in them.
Matrix3 spring_hessian(Real stiffness);
/// Of `tie`, likewise.
Matrix3 tie_hessian(const Vec3& offset, const Vec3& along, Real stiffness, Real yield);
/// Of `contact`, likewise.
Matrix3 contact_hessian(Real distance, const Vec3& normal, Real gap, Real stiffness);

}  // namespace gracilis::tissue
