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

TEST(SectionMap, there_is_none_for_a_line_without_area_or_one_that_crosses_itself) {
  const SquareCorners corners = {0, 0.25, 0.5, 0.75};
  EXPECT_FALSE(SectionMap::build(polygon({{0, 0}, {1, 0}}, 10), corners));
  EXPECT_FALSE(SectionMap::build(polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1.2}}, 10), corners));
}

}  // namespace gracilis
