#include <gracilis/opensim/wrapping.hpp>

#include <gracilis/opensim/golden_section.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

using Vec2 = Eigen::Vector2d;

/// The angle to turn from one direction to another counterclockwise, from 0 to less than 2 pi.
static Real turn(const Vec2& from, const Vec2& to) {
  const Real angle = std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
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
static Wrap::Kind kind_of_wrap(const WrapObject& object, const Vec3& a, const Vec3& b) {
  const Nearest near = nearest_to_axis(a, b);
  const bool cuts = near.distance < object.radius && near.parameter > 0 && near.parameter < 1;
  if (object.side_sign == 0) return cuts ? Wrap::Kind::needed : Wrap::Kind::none;
  const int sa = sign_of(a[object.side_axis]), sb = sign_of(b[object.side_axis]);
  if (sa != object.side_sign && sb != object.side_sign) return Wrap::Kind::held;
  if (cuts) return Wrap::Kind::needed;
  const bool passes_wrong = sa != sb && sign_of(near.place[object.side_axis]) != object.side_sign;
  return passes_wrong ? Wrap::Kind::held : Wrap::Kind::none;
}

/// Which way round a path that is held on one side goes: the way that touches on that side. +1 is counterclockwise.
static int held_direction(const WrapObject& object, const Vec2& a, const Vec2& b) {
  const Real r = object.radius;
  const Vec2 first_ccw = tangent_point(a, r, 1), first_cw = tangent_point(a, r, -1);
  const Vec2 last_ccw = tangent_point(b, r, -1), last_cw = tangent_point(b, r, 1);
  const auto on_side = [&](const Vec2& p) { return sign_of(p[object.side_axis]) == object.side_sign; };
  if (on_side(first_ccw) != on_side(first_cw)) return on_side(first_ccw) ? 1 : -1;
  if (on_side(last_cw)) return -1;
  if (on_side(last_ccw) || on_side(first_ccw)) return 1;
  // None touches on the side: of the ways around the other side, the one that does not cross itself.
  return first_ccw.dot(last_ccw) < first_cw.dot(last_cw) ? 1 : -1;
}

/// Whether the way in an obstacle's sense touches it on less than half a turn.
static bool obstacle_is_met(const WrapObject& object, const Vec2& from, const Vec2& to) {
  const Vec2 first = tangent_point(from, object.radius, object.hand);
  const Vec2 last = tangent_point(to, object.radius, -object.hand);
  return object.hand * (first.x() * last.y() - first.y() * last.x()) >= 0;
}

/// +1 is counterclockwise; where nothing holds the path, the shorter way.
static int direction_around(const WrapObject& object, const Vec2& from, const Vec2& to) {
  if (object.hand != 0) return object.hand;
  if (object.side_sign != 0 && object.side_axis < 2) return held_direction(object, from, to);
  const Real r = object.radius;
  const Real ccw = turn(tangent_point(from, r, 1), tangent_point(to, r, -1));
  const Real cw = turn(tangent_point(to, r, 1), tangent_point(from, r, -1));
  return ccw <= cw ? 1 : -1;
}

static Wrap wrap_cylinder(const WrapObject& object, const Vec3& a, const Vec3& b) {
  Wrap wrap;
  const Real r = object.radius;
  const Vec2 from = a.head<2>(), to = b.head<2>();
  if (from.norm() < r || to.norm() < r) {
    wrap.kind = Wrap::Kind::inside;
    return wrap;
  }
  wrap.kind = object.hand == 0                    ? kind_of_wrap(object, a, b)
              : obstacle_is_met(object, from, to) ? Wrap::Kind::needed
                                                  : Wrap::Kind::none;
  if (wrap.kind == Wrap::Kind::none) return wrap;
  const int direction = direction_around(object, from, to);
  const Vec2 first = tangent_point(from, r, direction), last = tangent_point(to, r, -direction);
  const Real angle = direction > 0 ? turn(first, last) : turn(last, first);
  // The way is straight once the cylinder is unrolled, so height grows evenly along it.
  const Real before = (first - from).norm(), on = r * angle, after = (last - to).norm();
  const Real rise = (b.z() - a.z()) / (before + on + after);
  wrap.first << first, a.z() + rise * before;
  wrap.last << last, b.z() - rise * after;
  wrap.length = on * std::sqrt(1 + rise * rise);
  const Real half = object.length / 2;
  if (std::abs(wrap.first.z()) > half && std::abs(wrap.last.z()) > half) wrap.kind = Wrap::Kind::none;
  return wrap;
}

/// In the plane of both points and the center; where the path is held on a side that the shorter way does not touch,
/// the longer way round.
static Wrap wrap_sphere(const WrapObject& object, const Vec3& a, const Vec3& b) {
  Wrap wrap;
  const Real r = object.radius;
  if (a.norm() < r || b.norm() < r) {
    wrap.kind = Wrap::Kind::inside;
    return wrap;
  }
  const Real parameter = -a.dot(b - a) / (b - a).squaredNorm();
  const Vec3 nearest = a + parameter * (b - a);
  const bool cuts = parameter > 0 && parameter < 1 && nearest.norm() < r;
  if (!cuts) return wrap;
  wrap.kind = Wrap::Kind::needed;
  const Vec3 x = a.normalized();
  Vec3 y = b - b.dot(x) * x;
  y = y.norm() > 1e-12 * b.norm() ? y.normalized() : x.unitOrthogonal();
  const Vec2 from(a.norm(), 0), to(b.dot(x), b.dot(y));
  int direction = 1;
  if (object.side_sign != 0) {
    const Vec2 first = tangent_point(from, r, 1), last = tangent_point(to, r, -1);
    const Vec2 middle = first + last;
    const Real side = (x * middle.x() + y * middle.y())[object.side_axis];
    if (sign_of(side) != object.side_sign) direction = -1;
  }
  const Vec2 first = tangent_point(from, r, direction), last = tangent_point(to, r, -direction);
  wrap.first = x * first.x() + y * first.y();
  wrap.last = x * last.x() + y * last.y();
  wrap.length = r * (direction > 0 ? turn(first, last) : turn(last, first));
  return wrap;
}

/// The point of a circle about z that is nearest to the line from a to b: its angle, searched on 64 points and then
/// between them. Where the circle is held on a side, of the points there.
static Real nearest_of_ring(const WrapObject& object, const Vec3& a, const Vec3& b) {
  const Vec3 along = (b - a).normalized();
  const auto distance = [&](Real angle) {
    const Vec3 p = object.ring_radius * Vec3(std::cos(angle), std::sin(angle), 0);
    const bool wrong =
        object.side_sign != 0 && object.side_axis < 2 && sign_of(p[object.side_axis]) != object.side_sign;
    const Vec3 off = p - a;
    return (off - off.dot(along) * along).norm() + (wrong ? 1e3 : 0);
  };
  const Real step = 2 * pi / 64;
  Real best = 0;
  for (int i = 1; i < 64; ++i)
    if (distance(i * step) < distance(best)) best = i * step;
  return least_between(best - step, best + step, distance);
}

static Wrap wrap_torus(const WrapObject& object, const Vec3& a, const Vec3& b) {
  const Real angle = nearest_of_ring(object, a, b);
  // The cylinder's x points to the ring's center, its z along the ring.
  const Vec3 out(std::cos(angle), std::sin(angle), 0), along(-out.y(), out.x(), 0);
  RigidTransform frame = RigidTransform::Identity();
  frame.translation() = object.ring_radius * out;
  frame.linear() << -out, along.cross(-out), along;
  WrapObject tube;
  tube.radius = object.radius;
  tube.length = 1e4;
  tube.side_axis = 0;
  tube.side_sign = 1;
  Wrap wrap = wrap_cylinder(tube, frame.inverse() * a, frame.inverse() * b);
  wrap.first = frame * wrap.first;
  wrap.last = frame * wrap.last;
  return wrap;
}

Wrap wrap_around(const WrapObject& object, const Vec3& a, const Vec3& b) {
  switch (object.kind) {
    case WrapObject::Kind::cylinder:
      return wrap_cylinder(object, a, b);
    case WrapObject::Kind::sphere:
      return wrap_sphere(object, a, b);
    case WrapObject::Kind::ellipsoid:
      return wrap_ellipsoid(object, a, b);
    case WrapObject::Kind::torus:
      return wrap_torus(object, a, b);
  }
  return {};
}

}  // namespace gracilis::opensim
