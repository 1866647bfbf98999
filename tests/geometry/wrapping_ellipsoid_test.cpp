#include <gracilis/geometry/wrapping_ellipsoid.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace gracilis {
namespace {

/// Half axes, the longest of which is along each axis once.
const std::array<Vec3, 3> all_radii = {Vec3(0.8, 1, 1.2), Vec3(1.2, 0.8, 1), Vec3(1, 1.2, 0.8)};

/// Of an ellipse about the origin.
Real distance_to_ellipse(Real a, Real b, Real x, Real y) {
  Real least = 1e9;
  for (int i = 0; i < 20000; ++i) {
    const Real angle = 2 * pi * i / 20000;
    least = std::min(least, std::hypot(a * std::cos(angle) - x, b * std::sin(angle) - y));
  }
  return least;
}

}  // namespace

TEST(NearestOnEllipsoid, leads_straight_across_it_and_is_the_nearest_in_its_octant) {
  std::mt19937 chance(3);
  std::uniform_real_distribution<Real> uniform(-1.5, 1.5);
  for (const Vec3& radii : all_radii)
    for (int i = 0; i < 100; ++i) {
      const Vec3 p(uniform(chance), uniform(chance), uniform(chance));
      if (p.cwiseAbs().minCoeff() < 1e-3) continue;
      const Vec3 found = nearest_on_ellipsoid(radii, p);
      EXPECT_NEAR(found.cwiseQuotient(radii).norm(), 1, 1e-12);
      const Vec3 normal = found.cwiseQuotient(radii.cwiseAbs2()).normalized();
      EXPECT_LT((p - found).cross(normal).norm(), 1e-10);
      EXPECT_GT(p.cwiseProduct(found).minCoeff(), 0);
    }
}

TEST(NearestOnEllipsoid, a_point_beside_a_plane_of_symmetry_keeps_to_it) {
  std::mt19937 chance(4);
  std::uniform_real_distribution<Real> uniform(-1.3, 1.3);
  for (const Vec3& radii : all_radii)
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < 12; ++i) {
        Vec3 p(uniform(chance), uniform(chance), uniform(chance));
        p[axis] = std::array{0.0, 9e-5, -9e-5}[static_cast<std::size_t>(i % 3)];
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const Vec3 found = nearest_on_ellipsoid(radii, p);
        EXPECT_EQ(found[axis], p[axis]);
        EXPECT_NEAR(std::hypot(found[u] / radii[u], found[v] / radii[v]), 1, 1e-9);
        const Real distance = std::hypot(found[u] - p[u], found[v] - p[v]);
        const Real tried = distance_to_ellipse(radii[u], radii[v], p[u], p[v]);
        EXPECT_LE(distance, tried + 1e-12);
        EXPECT_GT(distance, tried - 2e-4) << "half of the way between those that are tried";
        Vec3 away = p;
        away[axis] = 1.1e-4;
        EXPECT_NE(nearest_on_ellipsoid(radii, away)[axis], 1.1e-4) << "farther than that it does not";
      }
}

TEST(NearestOnEllipsoid, on_an_axis_is_its_end_or_where_the_ellipse_across_the_longest_axis_is_nearest) {
  const Vec3 radii(0.8, 1, 1.2);  // so that points on an axis keep to the plane across z, but for those on z
  for (const Real sign : {1.0, -1.0}) {
    for (const Real x : {0.1, 0.7, 2.0})
      EXPECT_LT((nearest_on_ellipsoid(radii, {sign * x, 0, 0}) - Vec3(sign * 0.8, 0, 0)).norm(), 1e-12) << x;
    // Along the longer axis of the ellipse within a - b²/a of the middle its sides are nearer than its end.
    for (const Real y : {0.37, 0.7, 2.0})
      EXPECT_LT((nearest_on_ellipsoid(radii, {0, sign * y, 0}) - Vec3(0, sign, 0)).norm(), 1e-12) << y;
    for (const Real y : {0.1, 0.35}) {
      const Vec3 found = nearest_on_ellipsoid(radii, {0, sign * y, 0});
      EXPECT_NEAR(found.y(), sign * y / 0.36, 1e-12);
      EXPECT_NEAR(std::abs(found.x()), 0.8 * std::sqrt(1 - std::pow(y / 0.36, 2)), 1e-12);
      EXPECT_EQ(found.z(), 0);
    }
    // Of the planes across x and y the one across the longer y: an ellipse of 1.2 and 0.8.
    const Vec3 found = nearest_on_ellipsoid(radii, {0, 0, sign * 0.3});
    const Real z = 1.44 * 0.3 / (1.44 - 0.64);
    EXPECT_NEAR(found.z(), sign * z, 1e-12);
    EXPECT_NEAR(std::abs(found.x()), 0.8 * std::sqrt(1 - std::pow(z / 1.2, 2)), 1e-12);
    EXPECT_EQ(found.y(), 0);
    EXPECT_LT((nearest_on_ellipsoid(radii, {0, 0, sign * 1.5}) - Vec3(0, 0, sign * 1.2)).norm(), 1e-12);
  }
}

TEST(NearestOnEllipsoid, from_the_middle_leads_to_the_end_of_the_shortest_axis_on_its_side) {
  for (const Vec3& radii : all_radii)
    for (const Real off : {0.0, 5e-5, -5e-5}) {
      Index least = 0;
      radii.minCoeff(&least);
      const Vec3 found = nearest_on_ellipsoid(radii, Vec3::Constant(off));
      for (Index k = 0; k < 3; ++k)
        EXPECT_EQ(found[k], k != least ? off : off < 0 ? -radii[k] : radii[k]) << radii.transpose();
    }
}

}  // namespace gracilis
