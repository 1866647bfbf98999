#include <gracilis/geometry/point_triangle.hpp>

#include <gtest/gtest.h>

#include <random>

namespace gracilis {
namespace {

Real distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = nearest_barycentric(p, a, b, c);
  EXPECT_NEAR(u.sum(), 1, 1e-12);
  EXPECT_GE(u.minCoeff(), 0);
  return (u[0] * a + u[1] * b + u[2] * c - p).norm();
}

/// The least distance to points strewn evenly over the triangle: never below the true one.
Real strewn_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c, int steps) {
  Real least = std::numeric_limits<Real>::infinity();
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; i + j <= steps; ++j)
      least = std::min(least, (a + (b - a) * i / steps + (c - a) * j / steps - p).norm());
  return least;
}

}  // namespace

TEST(PointTriangle, is_the_nearest_of_all_points) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<Real> uniform(-1, 1);
  const auto random = [&] { return Vec3(uniform(generator), uniform(generator), uniform(generator)); };
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = 1.5 * random(), a = random(), b = random(), c = random();
    const Real found = distance(p, a, b, c), strewn = strewn_distance(p, a, b, c, 100);
    EXPECT_LE(found, strewn + 1e-12);
    EXPECT_GE(found, strewn - 0.03);
  }
}

TEST(PointTriangle, zeros_tell_corners_edges_and_the_inside) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  const auto zeros = [&](const Vec3& p) { return (nearest_barycentric(p, a, b, c).array() == 0).count(); };
  EXPECT_EQ(zeros({-1, -1, 2}), 2);
  EXPECT_EQ(zeros({3, -1, 0}), 2);
  EXPECT_EQ(zeros({-1, 3, 0}), 2);
  EXPECT_EQ(zeros({0.4, -1, 1}), 1);
  EXPECT_EQ(zeros({-1, 0.4, 1}), 1);
  EXPECT_EQ(zeros({2, 2, 1}), 1);
  EXPECT_EQ(zeros({0.2, 0.3, 5}), 0);
}

TEST(PointTriangle, of_a_degenerate_triangle_is_the_nearest_point_of_its_edges) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0.3, 0, 0);
  EXPECT_NEAR(distance({0.6, 2, 0}, a, b, c), 2, 1e-9);
  EXPECT_NEAR(distance({-1, 0, 0}, a, b, c), 1, 1e-9);
  EXPECT_NEAR(distance({0, 3, 4}, a, a, a), 5, 1e-9);
  EXPECT_NEAR(distance({0.5, 1, 0}, a, b, b), 1, 1e-9);
}

}  // namespace gracilis
