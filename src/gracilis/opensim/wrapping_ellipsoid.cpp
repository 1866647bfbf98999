#include <gracilis/opensim/wrapping.hpp>

#include <gracilis/opensim/golden_section.hpp>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

using Vec2 = Eigen::Vector2d;

namespace {

/// The way around an ellipsoid in one plane through both points. A point of the plane is origin + axes y; the ellipse
/// that the plane cuts out is |stretched (y - center)| = 1.
struct PlaneWay {
  Vec3 origin = Vec3::Zero();
  Eigen::Matrix<Real, 3, 2> axes;
  Eigen::Matrix2d to_circle = Eigen::Matrix2d::Identity(), from_circle = Eigen::Matrix2d::Identity();
  Vec2 center = Vec2::Zero();
  Real begin = 0, sweep = 0;  ///< rad, on the circle; the sign tells the sense
  Real arc = 0;               ///< m
  Real length = 0;            ///< m, of the whole way

  Vec3 at(Real angle) const { return origin + axes * (center + from_circle * Vec2(std::cos(angle), std::sin(angle))); }
};

}  // namespace

/// Length of the ellipse between two angles on its circle: Simpson's rule.
static Real arc_length(const PlaneWay& way) {
  const int parts = 64;
  Real sum = 0;
  for (int i = 0; i <= parts; ++i) {
    const Real angle = way.begin + way.sweep * i / parts;
    const Real speed = (way.from_circle * Vec2(-std::sin(angle), std::cos(angle))).norm();
    sum += (i == 0 || i == parts ? 1 : i % 2 == 1 ? 4 : 2) * speed;
  }
  return std::abs(way.sweep) * sum / (3 * parts);
}

/// In the plane of the line from a to b and `aside`, on the side that `aside` points to. An affine map takes ellipse to
/// circle and tangents to tangents. Precondition: the line cuts the ellipsoid between a and b.
static PlaneWay way_in_plane(const Vec3& inverse_squares, const Vec3& a, const Vec3& b, const Vec3& aside) {
  PlaneWay way;
  way.origin = a;
  way.axes << (b - a).normalized(), aside;
  const Eigen::Matrix2d form = way.axes.transpose() * inverse_squares.asDiagonal() * way.axes;
  const Vec2 slope = way.axes.transpose() * inverse_squares.asDiagonal() * a;
  way.center = -form.ldlt().solve(slope);
  const Vec3 middle = a + way.axes * way.center;
  const Real rest = 1 - middle.dot(inverse_squares.asDiagonal() * middle);
  const Eigen::Matrix2d lower = (form / rest).llt().matrixL();
  way.to_circle = lower.transpose();
  way.from_circle = way.to_circle.inverse();
  const Vec2 from = way.to_circle * (Vec2(0, 0) - way.center),
             to = way.to_circle * (Vec2((b - a).norm(), 0) - way.center);
  // The map keeps the orientation, so `aside` lies to the left of the line: the way turns clockwise.
  const Real first = std::atan2(from.y(), from.x()) - std::acos(std::min(1.0, 1 / from.norm()));
  const Real last = std::atan2(to.y(), to.x()) + std::acos(std::min(1.0, 1 / to.norm()));
  Real sweep = std::fmod(last - first, 2 * pi);
  if (sweep > 0) sweep -= 2 * pi;
  way.begin = first;
  way.sweep = sweep;
  way.arc = arc_length(way);
  way.length = (way.at(first) - a).norm() + way.arc + (b - way.at(first + sweep)).norm();
  return way;
}

/// Whether the straight line meets the ellipsoid between the points.
static bool line_cuts(const Vec3& radii, const Vec3& a, const Vec3& b) {
  const Vec3 from = a.cwiseQuotient(radii), along = (b - a).cwiseQuotient(radii);
  const Real parameter = -from.dot(along) / along.squaredNorm();
  return parameter > 0 && parameter < 1 && (from + parameter * along).norm() < 1;
}

Wrap wrap_ellipsoid(const WrapObject& object, const Vec3& a, const Vec3& b) {
  Wrap wrap;
  if (a.cwiseQuotient(object.radii).norm() < 1 || b.cwiseQuotient(object.radii).norm() < 1) {
    wrap.kind = Wrap::Kind::inside;
    return wrap;
  }
  if (!line_cuts(object.radii, a, b)) return wrap;
  wrap.kind = Wrap::Kind::needed;
  const Vec3 inverse_squares = object.radii.cwiseAbs2().cwiseInverse();
  const Vec3 u = (b - a).normalized().unitOrthogonal(), v = (b - a).normalized().cross(u);
  const auto way_at = [&](Real angle) {
    return way_in_plane(inverse_squares, a, b, std::cos(angle) * u + std::sin(angle) * v);
  };
  const auto cost = [&](Real angle) {
    const PlaneWay way = way_at(angle);
    const bool wrong =
        object.side_sign != 0 && (way.at(way.begin + way.sweep / 2)[object.side_axis] < 0 ? -1 : 1) != object.side_sign;
    return way.length + (wrong ? 1e3 : 0);
  };
  const Real step = 2 * pi / 32;
  Real best = 0, least = cost(0);
  for (int i = 1; i < 32; ++i) {
    const Real here = cost(i * step);
    if (!(here < least)) continue;
    least = here;
    best = i * step;
  }
  const PlaneWay way = way_at(least_between(best - step, best + step, cost));
  wrap.first = way.at(way.begin);
  wrap.last = way.at(way.begin + way.sweep);
  wrap.length = way.arc;
  return wrap;
}

}  // namespace gracilis::opensim
