#include <gracilis/geometry/isocontours.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

namespace gracilis {

static std::vector<Points> heights(const TriangleMesh& mesh, Real level) {
  return isocontours(mesh, build_topology(mesh.faces, mesh.vertex_count()), mesh.vertices.row(2).transpose(), level);
}

TEST(Isocontours, of_height_on_a_tube_are_its_rings) {
  const TriangleMesh tube = shapes::cylinder(0.02, 0.1, 64, 20);
  const std::vector<Points> loops = heights(tube, 0.0333);
  ASSERT_EQ(loops.size(), 1u);
  for (Index i = 0; i < loops[0].cols(); ++i) {
    EXPECT_NEAR(loops[0](2, i), 0.0333, 1e-12);
    EXPECT_NEAR(loops[0].col(i).head<2>().norm(), 0.02, 3e-5);
  }
  EXPECT_NEAR(closed_length(loops[0]), 2 * pi * 0.02, 1e-4);
}

TEST(Isocontours, have_the_higher_side_on_their_left) {
  const TriangleMesh tube = shapes::cylinder(0.02, 0.1, 64, 20);
  const Points loop = heights(tube, 0.05)[0];
  // Up is to the left of a walker on the outside who goes clockwise as seen from above.
  const Vec3 along = loop.col(1) - loop.col(0), outwards = {loop(0, 0), loop(1, 0), 0};
  EXPECT_GT(outwards.cross(along).z(), 0) << "normal × direction is the left side";
}

TEST(Isocontours, through_vertices_are_closed_too) {
  const TriangleMesh tube = shapes::cylinder(0.02, 0.1, 16, 10);
  const std::vector<Points> loops = heights(tube, tube.vertices(2, 16 * 3));
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_NEAR(closed_length(loops[0]), 16 * 2 * 0.02 * std::sin(pi / 16), 1e-9);
}

TEST(Isocontours, of_two_pieces_are_two_the_longest_first_and_beyond_the_range_there_is_none) {
  TriangleMesh two = shapes::sphere(Vec3::Zero(), 0.02, 4);
  const TriangleMesh other = shapes::sphere(Vec3(0.1, 0, 0), 0.03, 4);
  const Index n = two.vertex_count(), m = two.face_count();
  two.vertices.conservativeResize(3, n + other.vertex_count());
  two.vertices.rightCols(other.vertex_count()) = other.vertices;
  two.faces.conservativeResize(3, m + other.face_count());
  two.faces.rightCols(other.face_count()) = other.faces.array() + n;
  const std::vector<Points> loops = heights(two, 0.001);
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_GT(loops[0](0, 0), 0.05) << "the larger ball's";
  EXPECT_EQ(heights(two, 0.025).size(), 1u);
  EXPECT_TRUE(heights(two, 0.05).empty());
}

TEST(ResampledLoop, has_points_at_equal_distances_all_around) {
  Points square(3, 4);
  square << 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0;
  const Points loop = resampled_loop(square, 8);
  EXPECT_NEAR((loop.col(1) - Vec3(0.5, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((loop.col(7) - Vec3(0, 0.5, 0)).norm(), 0, 1e-12);
}

}  // namespace gracilis
