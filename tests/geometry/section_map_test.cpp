#include <gracilis/geometry/section_map.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {

static Points polygon(const std::vector<Eigen::Vector2d>& corners, Index per_side) {
  Points loop(3, static_cast<Index>(corners.size()) * per_side);
  for (std::size_t side = 0; side < corners.size(); ++side)
    for (Index i = 0; i < per_side; ++i) {
      const Eigen::Vector2d p =
          corners[side] + (corners[(side + 1) % corners.size()] - corners[side]) * (Real(i) / per_side);
      loop.col(static_cast<Index>(side) * per_side + i) = Vec3(p.x(), p.y(), 0.5);
    }
  return loop;
}

TEST(Delaunay, covers_the_hull_with_triangles_whose_circles_are_empty) {
  PlanePoints points(2, 40);
  for (Index i = 0; i < 40; ++i)
    points.col(i) << std::fmod(0.7548776662466927 * i, 1), std::fmod(0.569840290998 * i, 1);
  const Eigen::Matrix3Xi triangles = delaunay(points);
  ASSERT_GT(triangles.cols(), 40);
  for (Index t = 0; t < triangles.cols(); ++t) {
    PlanePoints corners(2, 3);
    corners << points.col(triangles(0, t)), points.col(triangles(1, t)), points.col(triangles(2, t));
    EXPECT_GT(polygon_area(corners), 0);
    // The circle's center is as far from all three corners.
    const Eigen::Vector2d u = corners.col(1) - corners.col(0), v = corners.col(2) - corners.col(0);
    Eigen::Matrix2d sides;
    sides << u.transpose(), v.transpose();
    const Eigen::Vector2d center = sides.inverse() * Eigen::Vector2d(u.squaredNorm(), v.squaredNorm()) / 2;
    const Eigen::RowVectorXd distances = (points.colwise() - (corners.col(0) + center)).colwise().norm();
    EXPECT_GE(distances.minCoeff(), center.norm() - 1e-9);
  }
}

TEST(SectionMap, of_a_rectangle_is_the_straight_one) {
  const Points loop = polygon({{0, 0}, {0.08, 0}, {0.08, 0.02}, {0, 0.02}}, 40);
  Real aspect = 0;
  const SquareCorners corners = square_corners(loop, aspect);
  EXPECT_NEAR(aspect, 4, 0.05);
  const std::optional<SectionMap> map = SectionMap::build(loop, corners);
  ASSERT_TRUE(map);
  EXPECT_NEAR((map->at(0.5, 0.5) - Vec3(0.04, 0.01, 0.5)).norm(), 0, 5e-4);
  // Which end is the beginning is free; distances are not.
  EXPECT_NEAR((map->at(0.25, 0.5) - map->at(0.75, 0.5)).norm(), 0.04, 1e-3);
  EXPECT_NEAR((map->at(0.5, 0.25) - map->at(0.5, 0.75)).norm(), 0.01, 5e-4);
}

TEST(SectionMap, of_a_crescent_stays_inside_it) {
  // A band bent around half a circle: the middle of its rim lies far outside of it.
  std::vector<Eigen::Vector2d> rim;
  for (int i = 0; i <= 40; ++i) rim.emplace_back(0.05 * std::cos(pi * i / 40), 0.05 * std::sin(pi * i / 40));
  for (int i = 40; i >= 0; --i) rim.emplace_back(0.04 * std::cos(pi * i / 40), 0.04 * std::sin(pi * i / 40));
  const Points loop = polygon(rim, 1);
  Real aspect = 0;
  const std::optional<SectionMap> map = SectionMap::build(loop, square_corners(loop, aspect));
  ASSERT_TRUE(map);
  EXPECT_GT(aspect, 10);
  for (Real a = 0.02; a < 1; a += 0.04)
    for (Real b = 0.1; b < 1; b += 0.2) {
      const Vec3 p = map->at(a, b);
      EXPECT_GT(p.head<2>().norm(), 0.0398) << a << " " << b;
      EXPECT_LT(p.head<2>().norm(), 0.0502) << a << " " << b;
      EXPECT_GT(p.y(), -1e-3);
    }
}

TEST(SectionMap, of_a_section_in_another_unit_and_elsewhere_is_the_same) {
  // An ellipse, bent out of its plane.
  Points loop(3, 90);
  for (Index i = 0; i < 90; ++i) {
    const Real angle = 2 * pi * i / 90;
    loop.col(i) = Vec3(0.03 * std::cos(angle), 0.01 * std::sin(angle), 0.002 * std::cos(2 * angle));
  }
  Real aspect = 0, other_aspect = 0;
  const SquareCorners corners = square_corners(loop, aspect);
  const std::optional<SectionMap> map = SectionMap::build(loop, corners);
  ASSERT_TRUE(map);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (const Real unit : {0.05, 1.0, 1000.0}) {
    const Points other = (unit * turn * loop).colwise() + Vec3(1, -2, 3);
    const SquareCorners others = square_corners(other, other_aspect);
    EXPECT_NEAR(other_aspect, aspect, 1e-9);
    // Which end is the beginning is free.
    const bool is_swapped = std::abs(others[0] - corners[0]) > 0.25;
    const std::optional<SectionMap> moved = SectionMap::build(other, corners);
    ASSERT_TRUE(moved) << unit;
    EXPECT_NEAR(std::remainder(others[is_swapped ? 2 : 0] - corners[0], 1), 0, 1e-6);
    for (const Real a : {0.1, 0.5, 0.8})
      for (const Real b : {0.2, 0.6}) {
        const Vec3 p = map->at(a, b), q = unit * turn * p + Vec3(1, -2, 3);
        EXPECT_LT((moved->at(a, b) - q).norm(), 2e-4 * unit) << unit << ": the lattice in it turns with its axes";
        EXPECT_LT((moved->nearest(q) - Eigen::Vector2d(a, b)).norm(), 0.2);
      }
  }
}

TEST(SectionMap, its_rim_goes_around_the_square_by_length) {
  const Points loop = polygon({{0, 0}, {0.04, 0}, {0.04, 0.04}, {0, 0.04}}, 30);
  const std::optional<SectionMap> map = SectionMap::build(loop, {0, 0.25, 0.5, 0.75});
  ASSERT_TRUE(map);
  for (const Real t : {0.0, 0.3, 0.7, 1.0}) {
    EXPECT_LT((map->at(t, 0) - Vec3(0.04 * t, 0, 0.5)).norm(), 1e-6);
    EXPECT_LT((map->at(1, t) - Vec3(0.04, 0.04 * t, 0.5)).norm(), 1e-6);
    EXPECT_LT((map->at(t, 1) - Vec3(0.04 * t, 0.04, 0.5)).norm(), 1e-6);
    EXPECT_LT((map->at(0, t) - Vec3(0, 0.04 * t, 0.5)).norm(), 1e-6);
  }
}

TEST(SectionMap, corners_of_a_rectangle_are_its_own) {
  for (const Real start : {0.0, 0.3}) {
    // Begun anywhere on the line: 80 and 20 mm, 200 mm in all.
    const Points whole = polygon({{0, 0}, {0.08, 0}, {0.08, 0.02}, {0, 0.02}}, 40);
    Points loop = whole;
    const auto shift = static_cast<Index>(start * 160);
    for (Index i = 0; i < 160; ++i) loop.col(i) = whole.col((i + shift) % 160);
    const Real passed = start == 0 ? 0 : (0.08 + 8 * 0.02 / 40) / 0.2;
    Real aspect = 0;
    const SquareCorners corners = square_corners(loop, aspect);
    EXPECT_NEAR(aspect, 4, 0.02);
    EXPECT_NEAR(corners[1] - corners[0], 0.4, 2e-3);
    EXPECT_NEAR(corners[2] - corners[1], 0.1, 2e-3);
    EXPECT_NEAR(corners[3] - corners[2], 0.4, 2e-3);
    // A long side begins where a short one ends, at either end.
    EXPECT_NEAR(std::remainder(corners[0] + passed, 0.5), 0, 4e-3) << start;
  }
}

TEST(SectionMap, of_a_circle_is_as_wide_as_thick) {
  Points loop(3, 200);
  for (Index i = 0; i < 200; ++i) loop.col(i) = 0.02 * Vec3(std::cos(pi * i / 100), std::sin(pi * i / 100), 0);
  Real aspect = 0;
  square_corners(loop, aspect);
  // No rectangle has so much area for its circumference as a circle: then a square.
  EXPECT_NEAR(aspect, 1, 1e-12);
  // An ellipse of 4 to 1: half of the circumference p and the area give sides of p/2 ± √(p²/4 - area).
  for (Index i = 0; i < 200; ++i) loop.col(i) = Vec3(0.04 * std::cos(pi * i / 100), 0.01 * std::sin(pi * i / 100), 0);
  square_corners(loop, aspect);
  const Real half = 0.17156843550313666 / 2, area = pi * 0.04 * 0.01;
  const Real thin = half / 2 - std::sqrt(half * half / 4 - area);
  EXPECT_NEAR(aspect, (half - thin) / thin, 0.02);
}

TEST(SectionMap, heights_are_harmonic) {
  // x y is harmonic; over the rim of a square it goes on as such inside.
  Points loop = polygon({{-0.02, -0.02}, {0.02, -0.02}, {0.02, 0.02}, {-0.02, 0.02}}, 30);
  for (Index i = 0; i < loop.cols(); ++i) loop(2, i) = 10 * loop(0, i) * loop(1, i);
  const std::optional<SectionMap> map = SectionMap::build(loop, {0, 0.25, 0.5, 0.75});
  ASSERT_TRUE(map);
  for (const Real a : {0.2, 0.5, 0.7})
    for (const Real b : {0.3, 0.5, 0.9}) {
      const Vec3 p = map->at(a, b);
      EXPECT_NEAR(p.z(), 10 * p.x() * p.y(), 5e-5) << a << ' ' << b << ", of 4 mm";
      EXPECT_NEAR(p.x(), 0.04 * a - 0.02, 2e-4) << "a square is mapped straight, by triangles of 4 mm";
      EXPECT_NEAR(p.y(), 0.04 * b - 0.02, 2e-4);
    }
}

TEST(SectionMap, a_line_that_begins_elsewhere_maps_the_same_way) {
  const Points loop = polygon({{0, 0}, {0.04, 0}, {0.04, 0.04}, {0, 0.04}}, 30);
  for (const SquareCorners& corners :
       {SquareCorners{-0.125, 0.125, 0.375, 0.625}, SquareCorners{0.125, 0.375, 0.625, 0.875}}) {
    const std::optional<SectionMap> map = SectionMap::build(loop, corners);
    ASSERT_TRUE(map);
    const auto on_rim = [&](Real share) -> Vec3 {
      const Real along = 4 * (share - std::floor(share)), rest = along - std::floor(along);
      const Vec3 corner[] = {{0, 0, 0.5}, {0.04, 0, 0.5}, {0.04, 0.04, 0.5}, {0, 0.04, 0.5}};
      const auto side = static_cast<std::size_t>(along) % 4;
      return corner[side] + rest * (corner[(side + 1) % 4] - corner[side]);
    };
    for (const Real t : {0.0, 0.2, 0.4, 0.9}) {  // a corner of the line itself, half way, is cut off
      EXPECT_LT((map->at(t, 0) - on_rim(corners[0] + t / 4)).norm(), 1e-6) << t;
      EXPECT_LT((map->at(1, t) - on_rim(corners[1] + t / 4)).norm(), 1e-6) << t;
      EXPECT_LT((map->at(1 - t, 1) - on_rim(corners[2] + t / 4)).norm(), 1e-6) << t;
      EXPECT_LT((map->at(0, 1 - t) - on_rim(corners[3] + t / 4)).norm(), 1e-6) << t;
    }
  }
}

TEST(Polygons, distances_insides_and_crossings_are_told) {
  PlanePoints square(2, 4), bow(2, 4);
  square << 0, 2, 2, 0, 0, 0, 2, 2;
  bow << 0, 2, 0, 2, 0, 2, 2, 0;
  EXPECT_NEAR(distance_to_polygon(square, {0.5, 1}), 0.5, 1e-15);
  EXPECT_NEAR(distance_to_polygon(square, {-3, -4}), 5, 1e-15);
  EXPECT_NEAR(distance_to_polygon(square, {1.8, 1}), 0.2, 1e-15);
  EXPECT_NEAR(distance_to_polygon(square, {1, 1.7}), 0.3, 1e-15);
  EXPECT_TRUE(inside_polygon(square, {0.1, 1.9}));
  EXPECT_FALSE(inside_polygon(square, {2.1, 1}));
  EXPECT_FALSE(inside_polygon(square, {-0.1, 1}));
  EXPECT_FALSE(inside_polygon(square, {1, 2.1}));
  EXPECT_TRUE(is_simple(square));
  EXPECT_FALSE(is_simple(bow));
  // The crossing may be that of the last side.
  for (int first = 0; first < 4; ++first) {
    PlanePoints turned(2, 4);
    for (int i = 0; i < 4; ++i) turned.col(i) = bow.col((i + first) % 4);
    EXPECT_FALSE(is_simple(turned)) << first;
  }
}

TEST(SectionMap, there_is_none_for_a_line_without_area_or_one_that_crosses_itself) {
  const SquareCorners corners = {0, 0.25, 0.5, 0.75};
  EXPECT_FALSE(SectionMap::build(polygon({{0, 0}, {1, 0}}, 10), corners));
  EXPECT_FALSE(SectionMap::build(polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1.2}}, 10), corners));
}

}  // namespace gracilis
