#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/nearest_triangle.hpp>
#include <gracilis/geometry/point_triangle.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <random>

namespace gracilis {
namespace {

Real nearest_by_looking_at_all(const TriangleMesh& mesh, const Vec3& p) {
  Real least = std::numeric_limits<Real>::infinity();
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Vec3 a = mesh.vertices.col(mesh.faces(0, f)), b = mesh.vertices.col(mesh.faces(1, f)),
               c = mesh.vertices.col(mesh.faces(2, f));
    const Vec3 u = nearest_barycentric(p, a, b, c);
    least = std::min(least, (u[0] * a + u[1] * b + u[2] * c - p).norm());
  }
  return least;
}

}  // namespace

TEST(NearestTriangle, agrees_with_looking_at_all_triangles) {
  const TriangleMesh mesh = shapes::cylinder(0.02, 0.1, 17, 9);
  const NearestTriangle tree(mesh);
  std::mt19937 generator(2);
  std::uniform_real_distribution<Real> uniform(-0.1, 0.15);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p(uniform(generator), uniform(generator), uniform(generator));
    const NearestPoint nearest = tree.query(p);
    ASSERT_GE(nearest.face, 0);
    EXPECT_NEAR(nearest.distance, nearest_by_looking_at_all(mesh, p), 1e-12);
    EXPECT_NEAR((nearest.point - p).norm(), nearest.distance, 1e-12);
    Vec3 point = Vec3::Zero();
    for (int k = 0; k < 3; ++k) point += nearest.barycentric[k] * mesh.vertices.col(mesh.faces(k, nearest.face));
    EXPECT_NEAR((point - nearest.point).norm(), 0, 1e-12);
  }
}

TEST(NearestTriangle, finds_nothing_beyond_its_reach_and_everything_within) {
  const NearestTriangle tree(shapes::box(Vec3::Zero(), Vec3::Ones()));
  const Vec3 p(0.5, 0.5, 1.25);
  EXPECT_EQ(tree.query(p, 0.249).face, -1);
  EXPECT_GE(tree.query(p, 0.251).face, 0);
  EXPECT_NEAR(tree.query(p, 0.251).distance, 0.25, 1e-12);
}

TEST(NearestTriangle, of_a_point_on_the_surface_is_at_no_distance) {
  const TriangleMesh mesh = shapes::sphere({1, 2, 3}, 0.05, 3);
  const NearestTriangle tree(mesh);
  for (Index v = 0; v < mesh.vertex_count(); v += 7) EXPECT_NEAR(tree.query(mesh.vertices.col(v)).distance, 0, 1e-12);
}

TEST(NearestTriangle, of_a_single_triangle_works_and_moves_with_its_owner) {
  NearestTriangle tree(shapes::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  const NearestTriangle moved = std::move(tree);
  EXPECT_NEAR(moved.query({0.2, 0.2, -3}).distance, 3, 1e-12);
}

TEST(NearestTriangle, leaves_the_number_of_threads_to_others) {
  const int before = thread_count();
  const NearestTriangle tree(shapes::box(Vec3::Zero(), Vec3::Ones()));
  EXPECT_EQ(thread_count(), before);
}

}  // namespace gracilis
