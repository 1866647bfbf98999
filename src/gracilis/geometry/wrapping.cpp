#include <gracilis/geometry/wrapping.hpp>

#include <algorithm>
#include <cmath>
#include <gracilis/geometry/wrapping_ellipsoid.hpp>
#include <vector>

namespace gracilis {

using Vec2 = Eigen::Vector2d;

Vec3 Arc::at(Real share) const {
  const Real angle = begin + share * sweep;
  return center + std::cos(angle) * u + std::sin(angle) * v + share * climb;
}

/// The angle to turn from one direction to another counterclockwise, from 0 to less than 2 pi. What rounding turns the
/// other way, where a line just touches, is no turn at all.
static Real turn(const Vec2& from, const Vec2& to) {
  const Real angle = std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
  if (std::abs(angle) < 1e-7) return std::max(angle, 0.0);
  return angle < 0 ? angle + 2 * pi : angle;
}

/// The point at which a line from p touches the circle about the origin: `sign` +1 runs on counterclockwise.
static Vec2 tangent_point(const Vec2& p, Real radius, int sign) {
  const Real cosine = radius / p.norm(), sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const Vec2 out = p.normalized(), side(-out.y(), out.x());
  return radius * (cosine * out + sign * sine * side);
}

/// Where the line from a to b is nearest to the z axis: its parameter on the line, the place, and the distance.
struct Nearest {
  Real parameter = 0, distance = 0;
  Vec3 place = Vec3::Zero();
};

static Nearest nearest_to_axis(const Vec3& a, const Vec3& b) {
  const Vec2 from = a.head<2>(), along = (b - a).head<2>();
  const Real length = along.squaredNorm();
  Nearest nearest;
  nearest.parameter = length > 0 ? -from.dot(along) / length : 0;
  nearest.place = a + nearest.parameter * (b - a);
  nearest.distance = nearest.place.head<2>().norm();
  return nearest;
}

static int sign_of(Real x) { return x < 0 ? -1 : 1; }

/// Whether the path has to be on the cylinder at all. A path held on one side is there also where the line, on its way
/// from one side to the other, passes the axis on the wrong side, and where both points lie on the wrong side.
static Wrap::Kind kind_of_wrap(const WrapSurface& surface, const Vec3& a, const Vec3& b) {
  const Nearest near = nearest_to_axis(a, b);
  const bool cuts = near.distance < surface.radius && near.parameter > 0 && near.parameter < 1;
  if (surface.side_sign == 0) return cuts ? Wrap::Kind::needed : Wrap::Kind::none;
  const int sa = sign_of(a[surface.side_axis]), sb = sign_of(b[surface.side_axis]);
  if (sa != surface.side_sign && sb != surface.side_sign) return Wrap::Kind::held;
  if (cuts) return Wrap::Kind::needed;
  const bool passes_wrong = sa != sb && sign_of(near.place[surface.side_axis]) != surface.side_sign;
  return passes_wrong ? Wrap::Kind::held : Wrap::Kind::none;
}

/// Which way round a path that is held on one side goes: the way that touches on that side. +1 is counterclockwise.
static int held_direction(const WrapSurface& surface, const Vec2& a, const Vec2& b) {
  const Real r = surface.radius;
  const Vec2 first_ccw = tangent_point(a, r, 1), first_cw = tangent_point(a, r, -1);
  const Vec2 last_ccw = tangent_point(b, r, -1), last_cw = tangent_point(b, r, 1);
  const auto on_side = [&](const Vec2& p) { return sign_of(p[surface.side_axis]) == surface.side_sign; };
  if (on_side(first_ccw) != on_side(first_cw)) return on_side(first_ccw) ? 1 : -1;
  if (on_side(last_cw)) return -1;
  if (on_side(last_ccw) || on_side(first_ccw)) return 1;
  // None touches on the side: of the ways around the other side, the one that does not cross itself.
  return first_ccw.dot(last_ccw) < first_cw.dot(last_cw) ? 1 : -1;
}

/// Whether the way in an obstacle's sense touches it on less than half a turn.
static bool obstacle_is_met(const WrapSurface& surface, const Vec2& from, const Vec2& to) {
  const Vec2 first = tangent_point(from, surface.radius, surface.hand);
  const Vec2 last = tangent_point(to, surface.radius, -surface.hand);
  return surface.hand * (first.x() * last.y() - first.y() * last.x()) >= 0;
}

/// +1 is counterclockwise; where nothing holds the path, the shorter way.
static int direction_around(const WrapSurface& surface, const Vec2& from, const Vec2& to) {
  if (surface.hand != 0) return surface.hand;
  if (surface.side_sign != 0 && surface.side_axis < 2) return held_direction(surface, from, to);
  const Real r = surface.radius;
  const Real ccw = turn(tangent_point(from, r, 1), tangent_point(to, r, -1));
  const Real cw = turn(tangent_point(to, r, 1), tangent_point(from, r, -1));
  return ccw <= cw ? 1 : -1;
}

/// From one direction to another, +1 counterclockwise.
static Real turn(const Vec2& from, const Vec2& to, int direction) {
  return direction > 0 ? turn(from, to) : -turn(to, from);
}

static Wrap wrap_cylinder(const WrapSurface& surface, const Vec3& a, const Vec3& b) {
  Wrap wrap;
  const Real r = surface.radius;
  const Vec2 from = a.head<2>(), to = b.head<2>();
  if (from.norm() < r || to.norm() < r) {
    wrap.kind = Wrap::Kind::inside;
    return wrap;
  }
  wrap.kind = surface.hand == 0                    ? kind_of_wrap(surface, a, b)
              : obstacle_is_met(surface, from, to) ? Wrap::Kind::needed
                                                   : Wrap::Kind::none;
  if (wrap.kind == Wrap::Kind::none) return wrap;
  const int direction = direction_around(surface, from, to);
  const Vec2 first = tangent_point(from, r, direction), last = tangent_point(to, r, -direction);
  wrap.way.begin = std::atan2(first.y(), first.x());
  wrap.way.sweep = turn(first, last, direction);
  // The way is straight once the cylinder is unrolled, so height grows evenly along it.
  const Real before = (first - from).norm(), on = r * std::abs(wrap.way.sweep), after = (last - to).norm();
  const Real whole = before + on + after, rise = whole > 0 ? (b.z() - a.z()) / whole : 0;
  wrap.way.center = {0, 0, a.z() + rise * before};
  wrap.way.u = r * Vec3::UnitX();
  wrap.way.v = r * Vec3::UnitY();
  wrap.way.climb = {0, 0, rise * on};
  wrap.length = on * std::sqrt(1 + rise * rise);
  const Real half = surface.length / 2;
  if (std::abs(wrap.first().z()) > half && std::abs(wrap.last().z()) > half) wrap.kind = Wrap::Kind::none;
  return wrap;
}

/// Around a circle in a plane with a on its x axis and b above it: the shorter way is counterclockwise. A path held on
/// a side goes the other way where neither point or one only lies on that side, unless the way there, from both points,
/// runs against it.
static int direction_around_sphere(const WrapSurface& surface, const Vec3& a, const Vec3& b, const Vec3& first_cw,
                                   const Vec3& last_cw) {
  if (surface.side_sign == 0) return 1;
  const int axis = surface.side_axis;
  if (sign_of(a[axis]) == surface.side_sign && sign_of(b[axis]) == surface.side_sign) return 1;
  return ((first_cw - a) + (last_cw - b))[axis] * surface.side_sign < 0 ? 1 : -1;
}

/// In the plane of both points and the center.
static Wrap wrap_sphere(const WrapSurface& surface, const Vec3& a, const Vec3& b) {
  Wrap wrap;
  const Real r = surface.radius;
  if (a.norm() < r || b.norm() < r) {
    wrap.kind = Wrap::Kind::inside;
    return wrap;
  }
  const Real parameter = -a.dot(b - a) / (b - a).squaredNorm();
  const Vec3 nearest = a + parameter * (b - a);
  const bool cuts = parameter > 0 && parameter < 1 && nearest.norm() < r;
  if (!cuts) return wrap;
  const auto on_side = [&](const Vec3& p) {
    return surface.side_sign != 0 && sign_of(p[surface.side_axis]) == surface.side_sign;
  };
  wrap.kind = on_side(a) || on_side(b) ? Wrap::Kind::needed : Wrap::Kind::held;
  const Vec3 x = a.normalized();
  Vec3 y = b - b.dot(x) * x;
  y = y.norm() > 1e-12 * b.norm() ? y.normalized() : x.unitOrthogonal();
  const Vec2 from(a.norm(), 0), to(b.dot(x), b.dot(y));
  const auto in_space = [&](const Vec2& p) -> Vec3 { return x * p.x() + y * p.y(); };
  const int direction =
      direction_around_sphere(surface, a, b, in_space(tangent_point(from, r, -1)), in_space(tangent_point(to, r, 1)));
  const Vec2 first = tangent_point(from, r, direction), last = tangent_point(to, r, -direction);
  wrap.way = {Vec3::Zero(), r * x, r * y, Vec3::Zero(), std::atan2(first.y(), first.x()), turn(first, last, direction)};
  wrap.length = r * std::abs(wrap.way.sweep);
  return wrap;
}

namespace {

/// The line from a to b, seen from a circle about z: where its points come nearest to the circle.
struct LineAndRing {
  Vec3 a, along;
  Real length = 0, ring = 0;

  Vec3 at(Real u) const { return a + u * along; }
  Real distance(const Vec3& p) const { return std::hypot(p.head<2>().norm() - ring, p.z()); }
  /// Half the slope of the distance's square.
  Real slope(Real u) const {
    const Vec3 p = at(u);
    const Real off = p.head<2>().norm();
    return p.dot(along) - (off > 0 ? ring * p.head<2>().dot(along.head<2>()) / off : 0);
  }
};

}  // namespace

/// The places along the line where it comes nearest: two at most. Beyond one ring radius about the point nearest to the
/// center the slope keeps its sign.
static std::vector<Real> near_places(const LineAndRing& line) {
  const int parts = 64;
  const Real middle = -line.a.dot(line.along);
  const auto place = [&](int i) { return middle + 1.001 * line.ring * (2.0 * i / parts - 1); };
  std::vector<Real> places;
  for (int i = 0; i < parts; ++i) {
    Real low = place(i), high = place(i + 1);
    if (!(line.slope(low) <= 0 && line.slope(high) > 0)) continue;
    for (int step = 0; step < 60; ++step) {
      const Real half = (low + high) / 2;
      (line.slope(half) <= 0 ? low : high) = half;
    }
    places.push_back(low);
  }
  return places;
}

/// The one that is reached downhill from a place on the line.
static Real downhill_from(const LineAndRing& line, const std::vector<Real>& places, Real from) {
  if (line.slope(from) < 0) {
    for (const Real place : places)
      if (place > from) return place;
    return places.back();
  }
  for (auto place = places.rbegin(); place != places.rend(); ++place)
    if (*place < from) return *place;
  return places.front();
}

/// The point of the line that is nearest to the torus' ring, of those reached from both ends; false where the path is
/// held on a side that has none.
static bool nearest_to_ring(const WrapSurface& surface, const Vec3& a, const Vec3& b, Vec3& nearest) {
  const LineAndRing line{a, (b - a).normalized(), (b - a).norm(), surface.ring_radius};
  const std::vector<Real> places = near_places(line);
  if (places.empty()) return false;
  const Vec3 from_a = line.at(downhill_from(line, places, 0)),
             from_b = line.at(downhill_from(line, places, line.length));
  const auto allowed = [&](const Vec3& p) {
    return surface.side_sign == 0 || sign_of(p[surface.side_axis]) == surface.side_sign;
  };
  if (!allowed(from_a) && !allowed(from_b)) return false;
  const bool first = allowed(from_a) && (!allowed(from_b) || line.distance(from_a) < line.distance(from_b));
  nearest = first ? from_a : from_b;
  return nearest.head<2>().norm() > 0;
}

static Wrap wrap_torus(const WrapSurface& surface, const Vec3& a, const Vec3& b) {
  Vec3 nearest;
  if ((b - a).norm() == 0 || !nearest_to_ring(surface, a, b, nearest)) return {};
  // The cylinder's x points to the ring's center, its z along the ring.
  Vec3 out = Vec3::Zero();
  out.head<2>() = nearest.head<2>().normalized();
  RigidTransform frame = RigidTransform::Identity();
  frame.translation() = surface.ring_radius * out;
  frame.linear() << -out, -Vec3::UnitZ(), out.cross(Vec3::UnitZ());
  WrapSurface tube;
  tube.radius = surface.radius;
  tube.length = 1e4;
  tube.side_axis = 0;
  tube.side_sign = 1;
  Wrap wrap = wrap_cylinder(tube, frame.inverse() * a, frame.inverse() * b);
  if (wrap.kind == Wrap::Kind::needed) wrap.kind = Wrap::Kind::held;
  wrap.way.center = frame * wrap.way.center;
  for (Vec3* direction : {&wrap.way.u, &wrap.way.v, &wrap.way.climb}) *direction = frame.linear() * *direction;
  return wrap;
}

Wrap wrap_around(const WrapSurface& surface, const Vec3& a, const Vec3& b, WrapSurface::Plane plane) {
  switch (surface.kind) {
    case WrapSurface::Kind::cylinder:
      return wrap_cylinder(surface, a, b);
    case WrapSurface::Kind::sphere:
      return wrap_sphere(surface, a, b);
    case WrapSurface::Kind::ellipsoid:
      return wrap_ellipsoid(surface, a, b, plane);
    case WrapSurface::Kind::torus:
      return wrap_torus(surface, a, b);
  }
  return {};
}

}  // namespace gracilis
