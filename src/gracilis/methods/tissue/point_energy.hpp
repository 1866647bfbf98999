#pragma once

#include <gracilis/methods/tissue/material.hpp>

namespace gracilis::tissue {

/// Energy of a point (J), its derivative by the point's place (N), and the second derivatives (N/m).
struct PointState {
  Real energy = 0;
  Vec3 gradient = Vec3::Zero();
  Matrix3 hessian = Matrix3::Zero();
};

/// A spring to a place. `offset`: from that place to the point, m; `stiffness` N/m.
PointState spring(const Vec3& offset, Real stiffness);

/// Fascia that ties a point to a place across the unit direction `along` and lets it glide along that. Yields: pulls by
/// stiffness · e / √(1 + (e / yield)²) where the point is e (m) off.
PointState tie(const Vec3& offset, const Vec3& along, Real stiffness, Real yield);

/// Keeps a point `gap` (m) away from a surface whose distance is `distance`, with gradient `normal`. The surface counts
/// as flat in the second derivatives.
PointState contact(Real distance, const Vec3& normal, Real gap, Real stiffness);

}  // namespace gracilis::tissue
