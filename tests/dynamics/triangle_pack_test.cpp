#include <gracilis/dynamics/contact/mesh/triangle_pack.hpp>
#include <gracilis/geometry/point_triangle.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

using namespace gracilis;

namespace {

using Triangle = std::array<Eigen::Vector3f, 3>;

TrianglePack pack_of(const std::array<Triangle, 4>& triangles) {
  std::array<TrianglePack::Rows, 3> corners;
  for (int lane = 0; lane < 4; ++lane)
    for (std::size_t k = 0; k < 3; ++k)
      corners[k].col(lane) << triangles[static_cast<std::size_t>(lane)][k], 7.0f;  // nobody reads the fourth
  return TrianglePack::of(corners[0], corners[1], corners[2]);
}

float distance_to(const Triangle& triangle, const Eigen::Vector3f& p) {
  const Vec3 a = triangle[0].cast<Real>(), b = triangle[1].cast<Real>(), c = triangle[2].cast<Real>();
  const Vec3 weights = nearest_barycentric(Vec3(p.cast<Real>()), a, b, c);
  return static_cast<float>((weights[0] * a + weights[1] * b + weights[2] * c - p.cast<Real>()).norm());
}

void expect_alike(const std::array<Triangle, 4>& triangles, const Eigen::Vector3f& p, float tolerance) {
  const Eigen::Array4f distances = pack_of(triangles).squared_distances(p).sqrt();
  for (int lane = 0; lane < 4; ++lane)
    EXPECT_NEAR(distances[lane], distance_to(triangles[static_cast<std::size_t>(lane)], p), tolerance) << lane;
}

}  // namespace

TEST(TrianglePack, distances_are_those_of_each_triangle_alone) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> within(-0.01f, 0.01f);
  const auto point = [&] { return Eigen::Vector3f(within(random), within(random), within(random)); };
  for (int trial = 0; trial < 500; ++trial) {
    std::array<Triangle, 4> triangles;
    for (Triangle& triangle : triangles) triangle = {point(), point(), point()};
    expect_alike(triangles, point(), 2e-6f);
  }
}

TEST(TrianglePack, needles_and_triangles_without_area_count_as_their_sides) {
  const Eigen::Vector3f a(0.001f, 0, 0), b(0.004f, 0, 0), c(0.0025f, 0, 0);
  const std::array<Triangle, 4> flat{{{a, b, c}, {a, a, b}, {a, a, a}, {a, b, c + Eigen::Vector3f(0, 1e-9f, 0)}}};
  for (const Eigen::Vector3f& p : {Eigen::Vector3f(0.002f, 0.001f, 0), Eigen::Vector3f(0, 0, 0.003f), a, c,
                                   Eigen::Vector3f(0.009f, 0.001f, 0.001f)})
    expect_alike(flat, p, 2e-6f);
}

TEST(TrianglePack, a_point_on_a_triangle_has_no_distance) {
  const Triangle triangle{Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(0.003f, 0, 0), Eigen::Vector3f(0, 0.004f, 0)};
  const TrianglePack pack = pack_of({triangle, triangle, triangle, triangle});
  for (const Eigen::Vector3f& p : {triangle[0], triangle[1], Eigen::Vector3f(0.001f, 0.001f, 0)})
    EXPECT_LT(pack.squared_distances(p).maxCoeff(), 1e-12f);
}

TEST(TrianglePack, areas_are_twice_the_areas_along_the_normals) {
  const Triangle triangle{Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(4, 0, 0), Eigen::Vector3f(1, 5, 0)};
  const TrianglePack::Rows areas = pack_of({triangle, triangle, triangle, triangle}).areas().columns();
  for (int lane = 0; lane < 4; ++lane) EXPECT_EQ(Eigen::Vector4f(areas.col(lane)), Eigen::Vector4f(0, 0, 15, 0));
}
