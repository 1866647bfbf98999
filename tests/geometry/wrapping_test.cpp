#include <gracilis/geometry/wrapping.hpp>
#include <gracilis/geometry/wrapping_ellipsoid.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace gracilis {

using Vec2 = Eigen::Vector2d;

/// Both ways from a to b around points of a plane: the two chains of their convex hull (Andrew 1979).
struct WaysAround {
  Real left = 0, right = 0;  ///< seen from a to b
};

static WaysAround ways_around(std::vector<Vec2> points, const Vec2& a, const Vec2& b) {
  points.push_back(a);
  points.push_back(b);
  std::sort(points.begin(), points.end(),
            [](const Vec2& p, const Vec2& q) { return p.x() < q.x() || (p.x() == q.x() && p.y() < q.y()); });
  const auto cross = [](const Vec2& o, const Vec2& p, const Vec2& q) {
    return (p - o).x() * (q - o).y() - (p - o).y() * (q - o).x();
  };
  std::vector<Vec2> hull;  // counterclockwise
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t start = hull.size();
    for (const Vec2& p : points) {
      while (hull.size() >= start + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  const auto index = [&](const Vec2& p) { return std::find(hull.begin(), hull.end(), p) - hull.begin(); };
  const auto n = static_cast<std::ptrdiff_t>(hull.size());
  if (index(a) == n || index(b) == n) return {};  // one in the hull of the others: no way around
  const auto chain = [&](std::ptrdiff_t from, std::ptrdiff_t to) {
    Real length = 0;
    for (std::ptrdiff_t i = from; i != to; i = (i + 1) % n)
      length += (hull[static_cast<std::size_t>((i + 1) % n)] - hull[static_cast<std::size_t>(i)]).norm();
    return length;
  };
  return {chain(index(b), index(a)), chain(index(a), index(b))};
}

static std::vector<Vec2> circle(Real radius) {
  std::vector<Vec2> points;
  for (int i = 0; i < 20000; ++i)
    points.emplace_back(radius * std::cos(2 * pi * i / 20000), radius * std::sin(2 * pi * i / 20000));
  return points;
}

static Real whole(const Wrap& wrap, const Vec3& a, const Vec3& b) {
  return (wrap.first() - a).norm() + wrap.length + (b - wrap.last()).norm();
}

/// The arc's own points, added up.
static Real traced(const Wrap& wrap) {
  Real length = 0;
  for (int i = 0; i < 20000; ++i) length += (wrap.way.at((i + 1) / 20000.0) - wrap.way.at(i / 20000.0)).norm();
  return length;
}

static WrapSurface cylinder() {
  WrapSurface surface;
  surface.radius = 0.1;
  surface.length = 10;
  return surface;
}

static WrapSurface ellipsoid(const Vec3& radii) {
  WrapSurface surface;
  surface.kind = WrapSurface::Kind::ellipsoid;
  surface.radii = radii;
  return surface;
}

struct Sweep {
  std::mt19937 random{7};
  Real number(Real low, Real high) { return std::uniform_real_distribution<Real>(low, high)(random); }
  Vec3 point(Real reach) { return {number(-reach, reach), number(-reach, reach), number(-reach, reach)}; }
};

TEST(Wrapping, around_a_cylinder_the_way_is_the_shortest_of_all) {
  const WrapSurface surface = cylinder();
  const std::vector<Vec2> disc = circle(surface.radius);
  Sweep sweep;
  int wrapped = 0;
  for (int i = 0; i < 300; ++i) {
    Vec3 a = sweep.point(0.25), b = sweep.point(0.25);
    if (i % 5 == 0) a.head<2>() *= 0.1000001 / a.head<2>().norm();  // all but on the surface
    if (i % 7 == 0) b.z() = a.z();
    const Wrap wrap = wrap_around(surface, a, b);
    if (a.head<2>().norm() < 0.1 || b.head<2>().norm() < 0.1) {
      EXPECT_EQ(wrap.kind, Wrap::Kind::inside);
      continue;
    }
    if (!wrap.touches()) continue;
    ++wrapped;
    const WaysAround ways = ways_around(disc, a.head<2>(), b.head<2>());
    EXPECT_NEAR(whole(wrap, a, b), std::hypot(std::min(ways.left, ways.right), b.z() - a.z()), 1e-8) << i;
    EXPECT_NEAR(traced(wrap), wrap.length, 1e-8);
    EXPECT_NEAR(wrap.first().head<2>().norm(), 0.1, 1e-15);
  }
  EXPECT_GT(wrapped, 80);
}

TEST(Wrapping, a_line_that_just_misses_or_touches_a_cylinder_is_as_long_as_a_straight_one) {
  const WrapSurface surface = cylinder();
  for (const Real off : {-1e-3, -1e-6, -1e-9, -1e-12, -1e-16, 0.0, 1e-16, 1e-12, 1e-9, 1e-6}) {
    const Vec3 a(-0.3, 0.1 + off, -0.1), b(0.35, 0.1 + off, 0.2);
    const Wrap wrap = wrap_around(surface, a, b);
    EXPECT_EQ(wrap.touches(), 0.1 + off < 0.1) << off;
    // Lengths change by about depth^1.5.
    if (!wrap.touches()) continue;
    EXPECT_NEAR(whole(wrap, a, b), (b - a).norm(), 10 * std::pow(-off, 1.5) + 1e-14) << off;
  }
}

TEST(Wrapping, the_side_that_a_cylinder_is_passed_on_decides_the_way) {
  Sweep sweep;
  const std::vector<Vec2> disc = circle(0.1);
  int wrapped = 0;
  for (int i = 0; i < 400; ++i) {
    WrapSurface surface = cylinder();
    surface.side_axis = i % 2;
    surface.side_sign = i % 4 < 2 ? 1 : -1;
    // Both points on the wrong side: always held.
    Vec3 a = sweep.point(0.3), b = sweep.point(0.3);
    a[surface.side_axis] = -surface.side_sign * std::abs(a[surface.side_axis]);
    b[surface.side_axis] = -surface.side_sign * std::abs(b[surface.side_axis]);
    const Wrap wrap = wrap_around(surface, a, b);
    if (wrap.kind == Wrap::Kind::inside) continue;
    ASSERT_EQ(wrap.kind, Wrap::Kind::held);
    const int across = 1 - surface.side_axis;
    if (a[across] * b[across] > 0) continue;  // beside each other: more than once around
    // Of the two ways that which goes through the far end of the disc.
    const Vec2 far = 0.1 * surface.side_sign * Vec2::Unit(surface.side_axis);
    const Vec2 from = a.head<2>(), to = b.head<2>();
    const Real side = (to - from).x() * (far - from).y() - (to - from).y() * (far - from).x();
    const WaysAround ways = ways_around(disc, from, to);
    if (ways.left == 0) continue;
    ++wrapped;
    EXPECT_NEAR(whole(wrap, a, b), std::hypot(side > 0 ? ways.left : ways.right, b.z() - a.z()), 1e-8) << i;
  }
  EXPECT_GT(wrapped, 100);
}

TEST(Wrapping, a_cylinder_ends_where_both_points_of_touch_are_beyond_it) {
  WrapSurface surface = cylinder();
  surface.length = 0.2;
  EXPECT_TRUE(wrap_around(surface, {-0.3, 0, 0}, {0.3, 0, 0.15}).touches());
  EXPECT_FALSE(wrap_around(surface, {-0.3, 0, 0.11}, {0.3, 0, 0.11}).touches());
}

TEST(Wrapping, around_a_sphere_the_way_is_the_shortest_of_all) {
  WrapSurface surface;
  surface.kind = WrapSurface::Kind::sphere;
  surface.radius = 0.1;
  const std::vector<Vec2> disc = circle(0.1);
  Sweep sweep;
  int wrapped = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3 a = sweep.point(0.25), b = i % 9 == 0 ? Vec3(-a * sweep.number(0.9, 1.2)) : sweep.point(0.25);
    const Wrap wrap = wrap_around(surface, a, b);
    if (!wrap.touches()) continue;
    ++wrapped;
    Vec3 y = b - b.dot(a.normalized()) * a.normalized();
    const Vec2 from(a.norm(), 0), to(b.dot(a.normalized()), y.norm());
    const WaysAround ways = ways_around(disc, from, to);
    EXPECT_NEAR(whole(wrap, a, b), std::min(ways.left, ways.right), 1e-8) << i;
    EXPECT_NEAR(traced(wrap), wrap.length, 1e-8);
  }
  EXPECT_GT(wrapped, 80);
}

TEST(Wrapping, a_sphere_held_on_a_side_is_passed_there) {
  WrapSurface surface;
  surface.kind = WrapSurface::Kind::sphere;
  surface.radius = 0.1;
  surface.side_axis = 1;
  for (const int sign : {1, -1}) {
    surface.side_sign = sign;
    for (const Real height : {-0.05, -0.01, 0.01, 0.05}) {
      const Wrap wrap = wrap_around(surface, {-0.3, height, 0.01}, {0.4, height, -0.02});
      EXPECT_GT(sign * wrap.way.at(0.5).y(), 0.09) << height;
      EXPECT_EQ(wrap.kind, height * sign > 0 ? Wrap::Kind::needed : Wrap::Kind::held);
    }
  }
}

/// A string from a to b that is drawn tight around an ellipsoid: points in their neighbors' middle, those within it
/// put onto its surface; twice as many again and again.
static Real tight_string(const Vec3& radii, const Vec3& a, const Vec3& b, const Vec3& over) {
  const auto outside = [&](Vec3 p) {
    for (int i = 0; i < 4; ++i) {
      const Real f = p.cwiseQuotient(radii).squaredNorm() - 1;
      if (f >= 0) return p;
      const Vec3 gradient = 2 * p.cwiseQuotient(radii.cwiseAbs2());
      p -= f / gradient.squaredNorm() * gradient;
    }
    return p;
  };
  std::vector<Vec3> string = {a, over, b};
  for (int doubling = 0; doubling < 7; ++doubling) {
    std::vector<Vec3> finer;
    for (std::size_t i = 0; i + 1 < string.size(); ++i) {
      finer.push_back(string[i]);
      finer.push_back((string[i] + string[i + 1]) / 2);
    }
    finer.push_back(string.back());
    string = std::move(finer);
    for (int round = 0; round < 300; ++round)
      for (std::size_t i = 1; i + 1 < string.size(); ++i) string[i] = outside((string[i - 1] + string[i + 1]) / 2);
  }
  Real length = 0;
  for (std::size_t i = 1; i < string.size(); ++i) length += (string[i] - string[i - 1]).norm();
  return length;
}

/// The way in the plane of a, b and a point of the way, by the hull of the ellipse that the plane cuts out.
static Real way_in_same_plane(const Vec3& radii, const Vec3& a, const Vec3& b, const Vec3& through) {
  const Vec3 x = (b - a).normalized(), y = ((through - a) - (through - a).dot(x) * x).normalized();
  const Vec3 inside = through - 1e-6 * (through.cwiseQuotient(radii.cwiseAbs2())).normalized();
  std::vector<Vec2> ellipse;
  for (int i = 0; i < 20000; ++i) {
    const Real angle = 2 * pi * i / 20000;
    const Vec3 ray = (std::cos(angle) * x + std::sin(angle) * y).cwiseQuotient(radii);
    const Vec3 start = inside.cwiseQuotient(radii);
    const Real half = ray.dot(start) / ray.squaredNorm();
    const Real reach = std::sqrt(half * half + (1 - start.squaredNorm()) / ray.squaredNorm()) - half;
    const Vec3 place = inside + reach * (std::cos(angle) * x + std::sin(angle) * y) - a;
    ellipse.emplace_back(place.dot(x), place.dot(y));
  }
  return ways_around(ellipse, {0, 0}, {(b - a).norm(), 0}).left;
}

TEST(Wrapping, around_an_ellipsoid_the_way_lies_in_a_plane_and_is_hardly_longer_than_the_shortest) {
  Sweep sweep;
  int wrapped = 0;
  Real longest = 0;
  for (int i = 0; i < 150; ++i) {
    const Vec3 radii(sweep.number(0.03, 0.06), sweep.number(0.03, 0.06), sweep.number(0.03, 0.08));
    const Vec3 a = sweep.point(0.15), b = sweep.point(0.15);
    for (const auto plane : {WrapSurface::Plane::hybrid, WrapSurface::Plane::midpoint}) {
      const Wrap wrap = wrap_around(ellipsoid(radii), a, b, plane);
      if (!wrap.touches()) continue;
      ++wrapped;
      const Vec3 top = wrap.way.at(0.5);
      EXPECT_NEAR(whole(wrap, a, b), way_in_same_plane(radii, a, b, top), 2e-7) << i;
      EXPECT_NEAR(traced(wrap), wrap.length, 1e-7);
      const Real shortest = tight_string(radii, a, b, top);
      EXPECT_GT(whole(wrap, a, b), shortest - 2e-6) << i;
      longest = std::max(longest, whole(wrap, a, b) - shortest);
    }
  }
  EXPECT_GT(wrapped, 40);
  EXPECT_LT(longest, 1e-3);
}

TEST(Wrapping, held_on_the_other_half_of_an_ellipsoid_the_way_by_the_middle_goes_through_the_mirrored_point) {
  WrapSurface surface = ellipsoid(Vec3(0.03, 0.04, 0.05));
  surface.side_axis = 2, surface.side_sign = -1;
  const Vec3 a(-0.11, -0.08, 0.012), b(0.09, 0.1, 0.016);
  Vec3 mirrored = nearest_on_ellipsoid(surface.radii, [&] {
    // The middle of the line's part within.
    const Vec3 from = a.cwiseQuotient(surface.radii), along = (b - a).cwiseQuotient(surface.radii);
    return Vec3(a - from.dot(along) / along.squaredNorm() * (b - a));
  }());
  ASSERT_GT(mirrored.z(), 0.01);
  mirrored.z() *= -1;
  const Wrap wrap = wrap_around(surface, a, b, WrapSurface::Plane::midpoint);
  ASSERT_TRUE(wrap.touches());
  const Vec3 across = (b - a).cross(mirrored - a).normalized();
  for (const Real share : {0.0, 0.5, 1.0}) EXPECT_NEAR(across.dot(wrap.way.at(share) - a), 0, 1e-9);
}

TEST(Wrapping, the_way_around_an_ellipsoid_does_not_jump) {
  const Vec3 radii(0.03, 0.05, 0.08);
  Sweep sweep;
  int steps = 0;
  for (int i = 0; i < 40; ++i) {
    const Vec3 a = sweep.point(0.2), turn = sweep.point(1).normalized();
    Real before = 0;
    for (int k = 0; k <= 600; ++k) {
      // A line through the center may go any way.
      const Vec3 b = Eigen::AngleAxisd(0.15 + k * 0.001, turn) * -a;
      const Wrap wrap = wrap_around(ellipsoid(radii), a, b);
      const Real length = wrap.touches() ? whole(wrap, a, b) : (b - a).norm();
      if (k > 0 && wrap.touches()) {
        ++steps;
        EXPECT_LT(std::abs(length - before), 0.001 * a.norm() + 5e-4) << i << " " << k;
      }
      before = length;
    }
  }
  EXPECT_GT(steps, 1000);
}

TEST(Wrapping, the_nearest_point_of_an_ellipsoid_is_the_nearest_of_very_many) {
  const Vec3 radii(0.8, 1, 1.2);
  Sweep sweep;
  for (int i = 0; i < 60; ++i) {
    Vec3 point = sweep.point(1.5);
    const Vec3 nearest = nearest_on_ellipsoid(radii, point);
    EXPECT_NEAR(nearest.cwiseQuotient(radii).norm(), 1, 1e-12);
    Real least = 1e9;
    for (int j = 0; j <= 200; ++j)
      for (int k = 0; k < 400; ++k) {
        const Real up = pi * j / 200, around = 2 * pi * k / 400;
        const Vec3 p =
            radii.cwiseProduct(Vec3(std::sin(up) * std::cos(around), std::sin(up) * std::sin(around), std::cos(up)));
        least = std::min(least, (p - point).norm());
      }
    EXPECT_LT((nearest - point).norm(), least + 1e-12);
    EXPECT_GT((nearest - point).norm(), least - 5e-3);
  }
}

TEST(Wrapping, through_a_torus_the_way_bends_about_the_tube_that_is_nearest_on_its_side) {
  WrapSurface surface;
  surface.kind = WrapSurface::Kind::torus;
  surface.radius = 0.05;
  surface.ring_radius = 0.2;
  const std::vector<Vec2> disc = circle(0.05);
  for (const Real turn : {0.0, 0.7, 2.5, 4.0}) {
    const Eigen::AngleAxisd about_z(turn, Vec3::UnitZ());
    const Vec3 a = about_z * Vec3(0.18, 0, -0.3), b = about_z * Vec3(0.16, 0, 0.25);
    surface.side_sign = 0;
    const Wrap wrap = wrap_around(surface, a, b);
    ASSERT_TRUE(wrap.touches());
    // In the plane through the axis: around the tube's circle, which lies at 0.2 from the axis; the way on its inside.
    const WaysAround ways = ways_around(disc, {0.18 - 0.2, -0.3}, {0.16 - 0.2, 0.25});
    EXPECT_NEAR(whole(wrap, a, b), ways.left, 1e-8);
    surface.side_axis = 0;
    surface.side_sign = std::cos(turn) < 0 ? 1 : -1;
    EXPECT_FALSE(wrap_around(surface, a, b).touches());
  }
  surface.side_sign = 0;
  EXPECT_FALSE(wrap_around(surface, {0.01, 0.02, -0.3}, {-0.01, 0.01, 0.3}).touches());
}

}  // namespace gracilis
