#include <gracilis/anatomy/attachments/attachments.hpp>

#include "shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gracilis {
namespace {

/// A sheet of n × n vertices, 1 mm apart, at height z; vertex i + n j at (i, j) mm.
TriangleMesh sheet(Index n, Real z) {
  std::vector<Vec3> vertices;
  std::vector<Eigen::Vector3i> faces;
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) vertices.emplace_back(0.001 * i, 0.001 * j, z);
  for (Index j = 0; j + 1 < n; ++j) {
    for (Index i = 0; i + 1 < n; ++i) {
      const Index a = i + n * j;
      faces.push_back({a, a + 1, a + n});
      faces.push_back({a + 1, a + n + 1, a + n});
    }
  }
  return shapes::mesh_of(vertices, faces);
}

Points points_mm(const std::vector<Vec3>& points) {
  Points result(3, static_cast<Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) result.col(static_cast<Index>(i)) = points[i] / 1000;
  return result;
}

/// A muscle's sheet 1 mm above a bone whose upper side is z = 0.
class Attachments : public testing::Test {
 protected:
  std::vector<Index> select(const AttachmentRule& rule) const {
    const NearestTriangle* trees[] = {&tree};
    return select_vertices(muscle, trees, rule);
  }

  const TriangleMesh muscle = sheet(11, 0.001);
  const TriangleMesh bone = shapes::box(Vec3(-0.02, -0.02, -0.01), Vec3(0.005, 0.03, 0));
  const NearestTriangle tree{bone};
};

TEST_F(Attachments, near_the_bone_is_what_lies_above_it) {
  const std::vector<Index> vertices = select(NearBone{0.0011});
  EXPECT_EQ(vertices.size(), 6u * 11u) << "columns x = 0 ... 5 mm";
  EXPECT_TRUE(std::is_sorted(vertices.begin(), vertices.end()));
  EXPECT_TRUE(select(NearBone{0.0009}).empty());
}

TEST_F(Attachments, an_open_line_takes_what_lies_along_it_and_a_cloud_only_what_lies_at_its_points) {
  const Points ends = points_mm({{1, 0, 0}, {1, 10, 0}});
  const auto taken = [&](LineKind kind) { return select(NearLandmarks{{{ends, kind}}, 0.002, 0.0011}); };
  EXPECT_EQ(taken(LineKind::open).size(), 11u);
  EXPECT_THAT(taken(LineKind::cloud), testing::ElementsAre(1, 1 + 110));
}

TEST_F(Attachments, a_closed_outline_takes_its_inside_too) {
  const Points square = points_mm({{0.5, 0.5, 0}, {4.5, 0.5, 0}, {4.5, 8.5, 0}, {0.5, 8.5, 0}});
  // Nothing lies within 0.1 mm of the outline itself, which is 1 mm below the muscle.
  EXPECT_EQ(select(NearLandmarks{{{square, LineKind::closed}}, 0.002, 0.0001}).size(), 4u * 8u);
  EXPECT_TRUE(select(NearLandmarks{{{square, LineKind::open}}, 0.002, 0.0001}).empty());
}

TEST_F(Attachments, landmarks_away_from_the_bone_take_nothing_unless_no_bone_is_asked_for) {
  const Points far = points_mm({{9, 5, 0}});
  EXPECT_TRUE(select(NearLandmarks{{{far, LineKind::cloud}}, 0.002, 0.002}).empty());
  EXPECT_EQ(select(NearPoints{{{far, LineKind::cloud}}, 0.0011}).size(), 1u);
}

TEST_F(Attachments, listed_vertices_are_sorted_and_taken_once) {
  EXPECT_THAT(select(ListedVertices{{7, 3, 7}}), testing::ElementsAre(3, 7));
}

TEST_F(Attachments, the_nearest_of_several_bones_counts) {
  const TriangleMesh other = shapes::box(Vec3(0.008, -0.02, -0.01), Vec3(0.03, 0.03, 0));
  const NearestTriangle other_tree(other);
  const NearestTriangle* trees[] = {&tree, &other_tree};
  EXPECT_EQ(select_vertices(muscle, trees, NearBone{0.0011}).size(), (6u + 3u) * 11u);
}

TEST(Outlines, an_outline_of_fewer_than_three_points_has_no_inside) {
  EXPECT_FALSE(inside_outline(points_mm({{0, 0, 0}, {1, 0, 0}}), Vec3::Zero(), 1));
  EXPECT_FALSE(inside_outline(Points(3, 0), Vec3::Zero(), 1));
}

TEST(Outlines, the_inside_of_a_concave_outline_leaves_out_its_bay) {
  const Points u = points_mm({{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {6, 9, 0}, {6, 3, 0}, {3, 3, 0}, {3, 9, 0}, {0, 9, 0}});
  EXPECT_TRUE(inside_outline(u, Vec3(0.0015, 0.006, 0), 0.001));
  EXPECT_TRUE(inside_outline(u, Vec3(0.0045, 0.0015, 0.0009), 0.001));
  EXPECT_FALSE(inside_outline(u, Vec3(0.0045, 0.006, 0), 0.001));
  EXPECT_FALSE(inside_outline(u, Vec3(0.0015, 0.006, 0.0011), 0.001)) << "too far from the outline's plane";
}

TEST(Outlines, the_inside_of_an_outline_with_slanted_sides_is_told_point_by_point) {
  const Points diamond = points_mm({{10.37, 0, 0}, {0, 6.11, 0}, {-10.37, 0, 0}, {0, -6.11, 0}});
  for (Real x = -10.5; x < 11; x += 1)
    for (Real y = -6.5; y < 7; y += 1)
      EXPECT_EQ(inside_outline(diamond, Vec3(x, y, 0) / 1000, 0.001), std::abs(x) / 10.37 + std::abs(y) / 6.11 < 1)
          << x << ' ' << y;
}

TEST(Outlines, the_distance_to_a_line_is_that_of_its_nearest_piece_wherever_it_lies) {
  const Points corners = points_mm({{100, 50, -20}, {110, 50, -20}, {110, 60, -20}});
  const Vec3 over_a_piece(0.107, 0.05, -0.016), beyond_the_end(0.11, 0.063, -0.024),
      by_the_open_side(0.103, 0.053, -0.02);
  EXPECT_NEAR(distance_to({corners, LineKind::open}, over_a_piece), 0.004, 1e-15);
  EXPECT_NEAR(distance_to({corners, LineKind::open}, beyond_the_end), 0.005, 1e-15);
  EXPECT_NEAR(distance_to({corners, LineKind::open}, by_the_open_side), 0.003, 1e-15);
  EXPECT_NEAR(distance_to({corners, LineKind::closed}, by_the_open_side), 0, 1e-15);
  EXPECT_NEAR(distance_to({corners, LineKind::cloud}, over_a_piece), 0.005, 1e-15);
}

TEST(Outlines, the_distance_to_a_line_with_a_repeated_point_is_finite) {
  const LandmarkSet line{points_mm({{0, 0, 0}, {0, 0, 0}, {4, 0, 0}}), LineKind::open};
  EXPECT_NEAR(distance_to(line, Vec3(0.002, 0.003, 0)), 0.003, 1e-15);
  EXPECT_NEAR(distance_to({points_mm({{0, 0, 0}}), LineKind::closed}, Vec3(0.002, 0, 0)), 0.002, 1e-15);
}

TEST(AttachmentAreas, inner_vertices_of_a_sheet_own_a_cell_each) {
  const TriangleMesh mesh = sheet(5, 0);
  EXPECT_NEAR(attachment_area(mesh, std::vector<Index>{12}).area, 1e-6, 1e-12);
  std::vector<Index> all(25);
  for (Index i = 0; i < 25; ++i) all[static_cast<std::size_t>(i)] = i;
  const AttachmentArea area = attachment_area(mesh, all);
  EXPECT_NEAR(area.area, 16e-6, 1e-12);
  EXPECT_FALSE(area.sliver());
}

TEST(AttachmentAreas, a_single_vertex_has_neither_length_nor_width) {
  const AttachmentArea area = attachment_area(sheet(5, 0), std::vector<Index>{12});
  EXPECT_EQ(area.length, 0);
  EXPECT_EQ(area.width, 0);
}

TEST(AttachmentAreas, the_width_is_the_area_over_the_length) {
  const TriangleMesh mesh = sheet(11, 0);
  std::vector<Index> rows;  // three rows from the second column to the last but one, whose vertices own a cell each
  for (Index j = 4; j < 7; ++j)
    for (Index i = 1; i < 10; ++i) rows.push_back(11 * j + i);
  const AttachmentArea area = attachment_area(mesh, rows);
  EXPECT_NEAR(area.area, 27e-6, 1e-12);
  EXPECT_NEAR(area.length, 0.008, 1e-12);
  EXPECT_NEAR(area.width, 27e-6 / 0.008, 1e-12);
}

TEST(AttachmentAreas, a_row_of_vertices_is_a_sliver) {
  const TriangleMesh mesh = sheet(31, 0);
  std::vector<Index> row;
  for (Index i = 0; i < 31; ++i) row.push_back(31 * 15 + i);
  const AttachmentArea area = attachment_area(mesh, row);
  EXPECT_NEAR(area.length, 0.030, 1e-12);
  EXPECT_TRUE(area.sliver());
  EXPECT_EQ(attachment_area(mesh, {}).area, 0);
}

TEST(AttachmentOutline, its_inside_is_told_on_the_bone_in_whatever_order_its_points_come) {
  // Half a cylinder's side: seen along the normal of the plane that fits the outline, its inside has no one place.
  const TriangleMesh bone = shapes::cylinder(0.01, 0.08, 48, 40);
  TriangleMesh muscle = bone;
  muscle.vertices.topRows(2) *= 1.1;
  std::vector<Vec3> around;
  for (int i = 0; i <= 12; ++i) {
    const Real angle = 1.5 * pi * i / 12;
    for (const Real z : {20.0, 60.0}) around.emplace_back(10 * std::cos(angle), 10 * std::sin(angle), z);
  }
  for (const Real angle : {0.0, 1.5 * pi})
    for (const Real z : {25.0, 30.0, 35.0, 40.0, 45.0, 50.0, 55.0})
      around.emplace_back(10 * std::cos(angle), 10 * std::sin(angle), z);
  const Points points = points_mm(around);
  const TriangleMesh* bones[] = {&bone};
  const NearestTriangle tree(bone);
  const NearestTriangle* trees[] = {&tree};
  const LandmarkSet outline = outline_on_bones(points, bones);
  ASSERT_EQ(outline.inside.size(), 1u);
  const std::vector<Index> taken = select_vertices(muscle, trees, NearLandmarks{{outline}, 0.002, 0.0001});
  EXPECT_GT(taken.size(), 500u);
  for (const Index v : taken) {
    const Vec3 p = muscle.vertices.col(v);
    const Real angle = std::atan2(p.y(), p.x());
    EXPECT_TRUE(p.z() > 0.019 && p.z() < 0.061 && (angle > -0.01 || angle < -pi / 2 + 0.01)) << p.transpose();
  }
}

}  // namespace
}  // namespace gracilis
