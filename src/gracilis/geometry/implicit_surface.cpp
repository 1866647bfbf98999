#include <gracilis/geometry/implicit_surface.hpp>
#include <gracilis/geometry/implicit_surface_spline.hpp>
#include <gracilis/geometry/point_segment.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace gracilis {

namespace {

Eigen::AlignedBox3d box_around(const Vec3& center, const Vec3& half) { return {center - half, center + half}; }

/// Answers with the distance to the bounds where that is large, and asks `near` otherwise.
template <typename Near>
ImplicitSolid bounded(const Eigen::AlignedBox3d& bounds, Near near) {
  return {[bounds, near = std::move(near)](const Vec3& point) {
            const Real to_bounds = bounds.exteriorDistance(point);
            return to_bounds > far_distance ? to_bounds : near(point);
          },
          bounds};
}

Eigen::AlignedBox3d box_of(const std::vector<ThickPoint>& points) {
  Eigen::AlignedBox3d box;
  for (const ThickPoint& p : points) box.extend(box_around(p.point, Vec3::Constant(p.radius)));
  return box;
}

}  // namespace

ImplicitSolid ball(const Vec3& center, Real radius) {
  return {[=](const Vec3& point) { return (point - center).norm() - radius; },
          box_around(center, Vec3::Constant(radius))};
}

ImplicitSolid ellipsoid(const Vec3& center, const Vec3& radii) {
  return bounded(box_around(center, radii), [=](const Vec3& point) {
    const Vec3 scaled = (point - center).cwiseQuotient(radii);
    const Real k = scaled.norm();
    const Real gradient = scaled.cwiseQuotient(radii).norm();
    return gradient > 0 ? k * (k - 1) / gradient : -radii.minCoeff();
  });
}

ImplicitSolid half_space(const Vec3& point, const Vec3& normal, const Eigen::AlignedBox3d& bounds) {
  const Vec3 direction = normal.normalized();
  return {[=](const Vec3& p) { return (p - point).dot(direction); }, bounds};
}

ImplicitSolid thick_curve(const std::vector<ThickPoint>& points) {
  assert(!points.empty());
  std::vector<ThickPoint> chain = spline_through(points, 6);
  const Eigen::AlignedBox3d bounds = box_of(chain);
  return bounded(bounds, [chain = std::move(chain)](const Vec3& point) {
    Real best = (point - chain.front().point).norm() - chain.front().radius;
    for (std::size_t i = 1; i < chain.size(); ++i) {
      const ThickPoint& a = chain[i - 1];
      const ThickPoint& b = chain[i];
      const Real t = nearest_on_segment<Vec3>(point, a.point, b.point);
      best = std::min(best, (point - a.point - t * (b.point - a.point)).norm() - a.radius - t * (b.radius - a.radius));
    }
    return best;
  });
}

Real smooth_minimum(Real a, Real b, Real blend) {
  const Real overlap = std::max(blend - std::abs(a - b), 0.0);
  return std::min(a, b) - (blend > 0 ? overlap * overlap / (4 * blend) : 0);
}

ImplicitSolid smooth_union(std::vector<ImplicitSolid> solids, Real blend) {
  assert(!solids.empty());
  Eigen::AlignedBox3d bounds;
  for (const ImplicitSolid& solid : solids) bounds.extend(solid.bounds);
  // Every fillet may add blend/4 to the solid.
  bounds = box_around(bounds.center(), bounds.sizes() / 2 + Vec3::Constant(blend / 2));
  return bounded(bounds, [solids = std::move(solids), blend](const Vec3& point) {
    Real value = std::numeric_limits<Real>::max();
    for (const ImplicitSolid& solid : solids) {
      // What is further than the blend from the best so far changes nothing: its bounds alone tell.
      if (solid.bounds.exteriorDistance(point) < value + blend)
        value = smooth_minimum(value, solid.distance(point), blend);
    }
    return value;
  });
}

ImplicitSolid smooth_difference(ImplicitSolid solid, ImplicitSolid removed, Real blend) {
  const Eigen::AlignedBox3d bounds = solid.bounds;
  return bounded(bounds, [solid = std::move(solid), removed = std::move(removed), blend](const Vec3& point) {
    return smooth_maximum(solid.distance(point), -removed.distance(point), blend);
  });
}

ImplicitSolid smooth_intersection(ImplicitSolid a, ImplicitSolid b, Real blend) {
  const Eigen::AlignedBox3d bounds = a.bounds.intersection(b.bounds);
  return bounded(bounds, [a = std::move(a), b = std::move(b), blend](const Vec3& point) {
    return smooth_maximum(a.distance(point), b.distance(point), blend);
  });
}

ImplicitSolid mirrored_in_z(ImplicitSolid solid, Real plane_z) {
  const auto mirror = [plane_z](const Vec3& p) { return Vec3(p.x(), p.y(), 2 * plane_z - p.z()); };
  Eigen::AlignedBox3d bounds(mirror(solid.bounds.min()));
  bounds.extend(mirror(solid.bounds.max()));
  return {[solid = std::move(solid), mirror](const Vec3& point) { return solid.distance(mirror(point)); }, bounds};
}

}  // namespace gracilis
