#include <gracilis/geometry/self_crossings.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace gracilis {
namespace {

std::ptrdiff_t crossing_count(const TriangleMesh& mesh) {
  const std::vector<char> crossing =
      crossing_faces(TriangleTree(mesh), mesh, build_topology(mesh.faces, mesh.vertex_count()).edges);
  return std::count(crossing.begin(), crossing.end(), 1);
}

TEST(SelfCrossings, a_straight_tube_has_none_though_its_edges_lie_in_the_planes_of_triangles_further_along) {
  TriangleMesh tube = shapes::cylinder(0.01, 0.16, 20, 40);
  EXPECT_EQ(crossing_count(tube), 0);
  tube.vertices.colwise() += Vec3(0.0255, 0, -0.08);
  EXPECT_EQ(crossing_count(tube), 0);
}

TEST(SelfCrossings, balls_that_pass_through_each_other_cross_along_a_ring) {
  const TriangleMesh balls =
      shapes::both(shapes::sphere(Vec3::Zero(), 0.01, 3), shapes::sphere({0.01, 0.0003, 0.0002}, 0.01, 3));
  const std::vector<char> crossing =
      crossing_faces(TriangleTree(balls), balls, build_topology(balls.faces, balls.vertex_count()).edges);
  ASSERT_GT(std::count(crossing.begin(), crossing.end(), 1), 40);
  const Real ring = 0.01 * std::sqrt(0.75);
  for (Index face = 0; face < balls.face_count(); ++face) {
    if (!crossing[static_cast<std::size_t>(face)]) continue;
    const Vec3 center = balls.vertices(Eigen::all, balls.faces.col(face)).rowwise().mean();
    EXPECT_NEAR(center.x(), 0.005, 0.002);
    EXPECT_NEAR(center.tail<2>().norm(), ring, 0.002);
  }
}

}  // namespace
}  // namespace gracilis
