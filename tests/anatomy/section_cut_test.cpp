#include <gracilis/anatomy/sections/section_cut.hpp>

#include <gracilis/anatomy/sections/section_rings.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gracilis {
namespace {

using Vec2 = Eigen::Vector2d;

/// Twice of it: positive where it runs counterclockwise.
Real twice_area(const Eigen::Matrix2Xd& curve) {
  Real sum = 0;
  for (Index i = 0, j = static_cast<Index>(curve.cols()) - 1; i < curve.cols(); j = i++)
    sum += curve(0, j) * curve(1, i) - curve(1, j) * curve(0, i);
  return sum;
}

/// A box of 4 × 6 × 10 about the origin with a box of 2 × 2 × 10 cut out of its middle.
TriangleMesh pipe() {
  TriangleMesh hole = shapes::box({-1, -1, -5}, {1, 1, 5});
  hole.faces.row(0).swap(hole.faces.row(1));
  return shapes::both(shapes::box({-2, -3, -5}, {2, 3, 5}), hole);
}

SectionCut cut_at(const TriangleMesh& surface, const Vec3& center) {
  return {surface, center, Vec3::UnitX(), Vec3::UnitY()};
}

}  // namespace

TEST(SectionCut, outlines_are_the_planes_curves_with_the_inside_to_their_left) {
  std::vector<Eigen::Matrix2Xd> curves = cut_at(pipe(), {0.5, 0, 0.25}).outlines();
  ASSERT_EQ(curves.size(), 2u);
  if (twice_area(curves[0]) < 0) std::swap(curves[0], curves[1]);
  EXPECT_NEAR(twice_area(curves[0]), 2 * 24, 1e-12);
  EXPECT_NEAR(twice_area(curves[1]), -2 * 4, 1e-12);
  EXPECT_NEAR(curves[0].row(0).maxCoeff(), 1.5, 1e-12) << "from the center";
  EXPECT_NEAR(curves[0].row(0).minCoeff(), -2.5, 1e-12);
}

TEST(SectionCut, rays_meet_the_surface_from_its_front_and_its_back_in_turn_nearest_first) {
  const SectionCut cut = cut_at(pipe(), {0, 0, 0.25});
  const std::vector<RayHit> hits = cut.hits({-3, 0.5}, {1, 0});
  ASSERT_EQ(hits.size(), 4u);
  const Real distances[] = {1, 2, 4, 5};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(hits[i].distance, distances[i], 1e-12);
    EXPECT_EQ(hits[i].back, i % 2 == 1) << i;
  }
  EXPECT_EQ(cut.hits({0, 0.25}, {0, 1}).size(), 2u) << "what lies behind is not met";
  EXPECT_TRUE(cut.hits({3, 0}, {0, 1}).empty());
}

TEST(SectionCut, points_in_the_wall_are_inside_and_those_in_the_hole_and_around_it_are_not) {
  const SectionCut cut = cut_at(pipe(), {0, 0, 0.25});
  for (const Real x : {-2.5, -1.5, -0.5, 0.5, 1.5, 2.5})
    for (const Real y : {-3.5, -2.5, -0.5, 0.25, 2.5, 3.5}) {
      const bool in_box = std::abs(x) < 2 && std::abs(y) < 3, in_hole = std::abs(x) < 1 && std::abs(y) < 1;
      EXPECT_EQ(cut.contains({x, y}), in_box && !in_hole) << x << ' ' << y;
    }
}

TEST(SectionCut, an_oblique_plane_cuts_an_oblique_section) {
  const Real tilt = radians(30);
  const SectionCut cut(shapes::box({-2, -3, -5}, {2, 3, 5}), Vec3::Zero(), Vec3(std::cos(tilt), 0, std::sin(tilt)),
                       Vec3::UnitY());
  const std::vector<Eigen::Matrix2Xd> curves = cut.outlines();
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_NEAR(twice_area(curves[0]) / 2, 24 / std::cos(tilt), 1e-12);
}

TEST(SectionCut, a_plane_beside_the_surface_cuts_nothing_and_one_through_vertices_what_lies_on_one_side) {
  const TriangleMesh box = shapes::box({-2, -3, -5}, {2, 3, 5});
  EXPECT_TRUE(cut_at(box, {0, 0, 5.1}).empty());
  EXPECT_FALSE(cut_at(box, {0, 0, 4.9}).empty());
  const std::vector<Eigen::Matrix2Xd> curves = cut_at(shapes::sphere(Vec3::Zero(), 1, 3), Vec3::Zero()).outlines();
  ASSERT_EQ(curves.size(), 1u) << "through the vertices of the equator";
  EXPECT_NEAR(twice_area(curves[0]) / 2, 16 * std::sin(2 * pi / 32), 1e-2) << "a polygon with 32 corners";
}

TEST(SectionRings, areas_are_those_of_the_polygon_about_the_center) {
  SectionRings rings;
  rings.rays = 4;
  rings.centers = (Points(3, 2) << 0, 0, 0, 0, 0, 2).finished();
  rings.corners.resize(3, 8);
  rings.corners << 3, 0, -1, 0, 6, 0, -2, 0,  //
      0, 2, 0, -1, 0, 4, 0, -2,               //
      0, 0, 0, 0, 2, 2, 2, 2;
  const Real quarters[] = {3, 1, 0.5, 1.5};
  for (Index i = 0; i < 4; ++i) {
    EXPECT_NEAR(triangle_area(rings, 0, i), quarters[i], 1e-15);
    EXPECT_NEAR(triangle_area(rings, 1, i), 4 * quarters[i], 1e-15);
  }
  EXPECT_NEAR(section_area(rings, 0), 6, 1e-15);
  EXPECT_NEAR(section_area(rings, 1), 24, 1e-15);
}

}  // namespace gracilis
