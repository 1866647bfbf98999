#include <gracilis/geometry/wrapping_ellipsoid.hpp>

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>

namespace gracilis {

using Vec2 = Eigen::Vector2d;

/// Nearer to a plane of symmetry than this, where the radii are about 1, a point keeps to it.
static constexpr Real near_plane = 1e-4;

/// The largest t with sum (a_i p_i / (t + a_i²))² = 1, where the sum is convex and falls: Newton's steps from the left.
/// Precondition: the component along the shortest half axis is not zero.
template <class Vector>
static Vector nearest_in_general(const Vector& radii, const Vector& p) {
  const Vector squares = radii.cwiseAbs2(), scaled = radii.cwiseProduct(p);
  Eigen::Index least = 0;
  radii.minCoeff(&least);
  Real t = -squares[least] + std::abs(scaled[least]);
  for (int i = 0; i < 100; ++i) {
    const Vector shares = scaled.cwiseQuotient((squares.array() + t).matrix());
    const Real off = shares.squaredNorm() - 1;
    const Real slope = -2 * (shares.cwiseAbs2().array() / (squares.array() + t)).sum();
    const Real step = off / slope;
    t -= step;
    if (std::abs(step) < 1e-15 * squares.maxCoeff()) break;
  }
  return squares.cwiseProduct(p).cwiseQuotient((squares.array() + t).matrix());
}

static Vec2 nearest_on_ellipse(const Vec2& radii, const Vec2& p) {
  const bool on_y = std::abs(p.x()) < near_plane, on_x = std::abs(p.y()) < near_plane;
  const auto sign = [](Real x) { return x < 0 ? -1 : 1; };
  if (on_x && on_y) {
    // From the center to the end of the shorter half axis.
    return radii.x() < radii.y() ? Vec2(sign(p.x()) * radii.x(), p.y()) : Vec2(p.x(), sign(p.y()) * radii.y());
  }
  if (!on_x && !on_y) return nearest_in_general(radii, p);
  const int along = on_x ? 0 : 1, across = 1 - along;
  const Real a = radii[along], b = radii[across], at = p[along];
  Vec2 nearest = p;
  if (b >= a || std::abs(at) >= a - b * b / a) {
    nearest[along] = sign(at) * a;
  } else {
    nearest[along] = a * a * at / (a * a - b * b);
    nearest[across] = b * std::sqrt(std::max(0.0, 1 - std::pow(nearest[along] / a, 2)));
  }
  return nearest;
}

/// In the plane of symmetry across `axis`.
static Vec3 nearest_in_plane(const Vec3& radii, const Vec3& p, int axis) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const Vec2 in_plane = nearest_on_ellipse({radii[i], radii[j]}, {p[i], p[j]});
  Vec3 nearest = p;
  nearest[i] = in_plane.x();
  nearest[j] = in_plane.y();
  return nearest;
}

Vec3 nearest_on_ellipsoid(const Vec3& radii, const Vec3& point) {
  int plane = -1;
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(point[axis]) < near_plane && (plane < 0 || radii[axis] > radii[plane])) plane = axis;
  return plane >= 0 ? nearest_in_plane(radii, point, plane) : nearest_in_general(radii, point);
}

namespace {

/// A line that cuts an ellipsoid between these points.
struct Cut {
  Vec3 radii, enter, leave;
  Vec3 direction;  ///< unit

  Vec3 at(Real share) const { return enter + share * (leave - enter); }
};

}  // namespace

/// Which way the surface is nearest, averaged over the line's part within; from the part's middle by that, the point
/// of the surface.
static Vec3 by_fan(const Cut& cut) {
  const int blades = 300;
  Vec3 sum = Vec3::Zero();
  for (int i = 1; i < blades - 1; ++i) {
    const Vec3 place = cut.at(static_cast<Real>(i) / blades);
    sum += (nearest_on_ellipsoid(cut.radii, place) - place).normalized();
  }
  return nearest_on_ellipsoid(cut.radii, cut.at(0.5) + sum.normalized());
}

/// A point of the surface that the way's plane goes through. Where the line runs along an axis, from where it crosses
/// the plane across that (share of axis 1), else by the fan, and between them a mixture, so that it does not jump.
static Vec3 surface_point(const Cut& cut, const WrapSurface& surface, WrapSurface::Plane plane) {
  const Real least = 0.7073, most = 0.9, fade = 0.3;  // OpenSim's; of the direction's cosine with the axis
  int axis = 0;
  Real along = cut.direction.cwiseAbs().maxCoeff(&axis);
  const Real crossing = -cut.enter[axis] / (cut.leave - cut.enter)[axis];
  if (plane == WrapSurface::Plane::hybrid && along > least) {
    // A crossing beyond or near the part's ends leads astray.
    const Real share = std::clamp(std::min(crossing, 1 - crossing) / fade, 0.0, 1.0);
    along = least + share * (along - least);
  }
  const Real axial = (along - least) / (most - least);
  Vec3 point;
  if (plane == WrapSurface::Plane::midpoint)
    point = nearest_on_ellipsoid(cut.radii, cut.at(0.5));
  else if (plane == WrapSurface::Plane::axial || axial >= 1)
    point = nearest_in_plane(cut.radii, cut.at(crossing), axis);
  else if (axial <= 0)
    point = by_fan(cut);
  else
    point = nearest_on_ellipsoid(
        cut.radii, axial * nearest_in_plane(cut.radii, cut.at(crossing), axis) + (1 - axial) * by_fan(cut));
  if (surface.side_sign != 0 && (point[surface.side_axis] < 0 ? -1 : 1) != surface.side_sign) {
    // Onto the other half; as far as the fan chose it, onto its rim.
    point[surface.side_axis] *= -1;
    const Real fan = plane == WrapSurface::Plane::hybrid ? std::min(1.0, 1 - axial) : 0;
    if (fan > 0) {
      point[surface.side_axis] *= 1 - fan;
      point = nearest_on_ellipsoid(cut.radii, point);
    }
  }
  return point;
}

/// Length of the arc: Simpson's rule.
static Real arc_length(const Arc& arc) {
  const int parts = 128;
  Real sum = 0;
  for (int i = 0; i <= parts; ++i) {
    const Real angle = arc.begin + arc.sweep * i / parts;
    const Real speed = (std::cos(angle) * arc.v - std::sin(angle) * arc.u).norm();
    sum += (i == 0 || i == parts ? 1 : i % 2 == 1 ? 4 : 2) * speed;
  }
  return std::abs(arc.sweep) * sum / (3 * parts);
}

/// In the plane of the line from a to b and `aside`, on the side that `aside` points to. An affine map takes ellipse to
/// circle and tangents to tangents. Precondition: the line cuts the ellipsoid between a and b.
static Arc way_in_plane(const Vec3& radii, const Vec3& a, const Vec3& b, const Vec3& aside) {
  const Vec3 inverse_squares = radii.cwiseAbs2().cwiseInverse();
  Eigen::Matrix<Real, 3, 2> axes;
  axes << (b - a).normalized(), aside;
  const Eigen::Matrix2d form = axes.transpose() * inverse_squares.asDiagonal() * axes;
  const Vec2 slope = axes.transpose() * inverse_squares.asDiagonal() * a;
  const Vec2 center = -form.ldlt().solve(slope);
  Arc way;
  way.center = a + axes * center;
  const Real rest = 1 - way.center.dot(inverse_squares.asDiagonal() * way.center);
  const Eigen::Matrix2d lower = (form / rest).llt().matrixL();
  const Eigen::Matrix2d to_circle = lower.transpose();
  const Eigen::Matrix<Real, 3, 2> from_circle = axes * to_circle.inverse();
  way.u = from_circle.col(0);
  way.v = from_circle.col(1);
  const Vec2 from = to_circle * (Vec2(0, 0) - center), to = to_circle * (Vec2((b - a).norm(), 0) - center);
  // The map keeps the orientation, so `aside` lies to the left of the line: the way turns clockwise.
  const auto touch = [](const Vec2& p) { return std::acos(std::min(1.0, 1 / p.norm())); };
  way.begin = std::atan2(from.y(), from.x()) - touch(from);
  const Real end = std::atan2(to.y(), to.x()) + touch(to);
  way.sweep = std::fmod(end - way.begin, 2 * pi);
  // Rounding may turn a line that just touches the other way.
  if (way.sweep > 0) way.sweep -= way.sweep < 1e-7 ? way.sweep : 2 * pi;
  return way;
}

Wrap wrap_ellipsoid(const WrapSurface& surface, const Vec3& a, const Vec3& b, WrapSurface::Plane plane) {
  // As OpenSim does, in units in which the radii are 1 on average: some tolerances are absolute.
  const Real unit = surface.radii.sum() / 3;
  const Vec3 radii = surface.radii / unit, from = a / unit, to = b / unit;
  Wrap wrap;
  const auto depth = [&](const Vec3& p) { return 1 - p.cwiseQuotient(radii).squaredNorm(); };
  if (depth(from) > 1e-4 || depth(to) > 1e-4) {
    wrap.kind = Wrap::Kind::inside;
    return wrap;
  }
  if (std::abs(1 - from.normalized().dot(to.normalized())) < 1e-4) return wrap;
  const Vec3 start = from.cwiseQuotient(radii), along = (to - from).cwiseQuotient(radii);
  const Real middle = -start.dot(along) / along.squaredNorm();
  const Real reach = 1 - (start + middle * along).squaredNorm();
  if (!(reach > 0)) return wrap;
  const Real half = std::sqrt(reach / along.squaredNorm());
  if (middle - half <= 0 || middle + half >= 1) return wrap;
  const Vec3 step = to - from, direction = step.normalized();
  const Cut cut{radii, from + (middle - half) * step, from + (middle + half) * step, direction};
  Vec3 aside = surface_point(cut, surface, plane) - from;
  aside -= aside.dot(direction) * direction;
  if (!(aside.norm() > 1e-12)) aside = direction.unitOrthogonal();
  wrap.kind = Wrap::Kind::needed;
  wrap.way = way_in_plane(radii, from, to, aside.normalized());
  for (Vec3* part : {&wrap.way.center, &wrap.way.u, &wrap.way.v}) *part *= unit;
  wrap.length = arc_length(wrap.way);
  return wrap;
}

}  // namespace gracilis
