#pragma once

#include <gracilis/core/types.hpp>

#include <functional>
#include <vector>

namespace gracilis {

/// A solid described by a function that is negative inside, positive outside and grows about as fast as distance does.
/// Far from the solid (beyond `far_distance`) the function may answer with a smaller positive number than the distance,
/// never with a larger one, so that composed solids stay cheap to evaluate.
struct ImplicitSolid {
  std::function<Real(const Vec3& point)> distance;  ///< m
  Eigen::AlignedBox3d bounds;                       ///< contains the solid
};

/// How far from its bounds a solid may answer with the distance to the bounds; m. Blends must be narrower than this.
inline constexpr Real far_distance = 0.015;

/// A center and the radius of the solid there.
struct ThickPoint {
  Vec3 point = Vec3::Zero();
  Real radius = 0;
};

/// The ball around `center`.
ImplicitSolid ball(const Vec3& center, Real radius);

/// The ellipsoid with half axes `radii` along the world's axes; distance scaled to first order (exact on the surface
/// only).
ImplicitSolid ellipsoid(const Vec3& center, const Vec3& radii);

/// All points p with (p - point)·normal <= 0, within `bounds`.
ImplicitSolid half_space(const Vec3& point, const Vec3& normal, const Eigen::AlignedBox3d& bounds);

/// The balls swept along the Catmull-Rom spline through `points` (at least one), their radii interpolated alike.
ImplicitSolid thick_curve(const std::vector<ThickPoint>& points);

/// Smaller of a and b, rounded where they differ by less than `blend`; lies at most blend/4 below the smaller one. A
/// polynomial smooth minimum: quadratic in the blend zone, continuous first derivative.
Real smooth_minimum(Real a, Real b, Real blend);
/// Larger of a and b, rounded as smooth_minimum does; at most blend/4 above the larger one.
inline Real smooth_maximum(Real a, Real b, Real blend) { return -smooth_minimum(-a, -b, blend); }

/// Everything in any of `solids` (at least one), with fillets about `blend` wide.
ImplicitSolid smooth_union(std::vector<ImplicitSolid> solids, Real blend);

/// `solid` without `removed`, the new edge rounded over about `blend`.
ImplicitSolid smooth_difference(ImplicitSolid solid, ImplicitSolid removed, Real blend);

/// What is in both, the new edge rounded over about `blend`.
ImplicitSolid smooth_intersection(ImplicitSolid a, ImplicitSolid b, Real blend);

/// `solid` mirrored in the plane z = `plane_z`.
ImplicitSolid mirrored_in_z(ImplicitSolid solid, Real plane_z);

}  // namespace gracilis
