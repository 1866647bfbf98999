#include <gracilis/geometry/box_tree.hpp>
#include <gracilis/geometry/point_triangle.hpp>
#include <gracilis/geometry/triangle_tree.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace gracilis {
namespace {

using Faces = std::set<Index>;

Faces met_by_boxes(const BoxTree& boxes, const Vec3& a, const Vec3& b) {
  Faces faces;
  boxes.along(a, b, [&](Index face, float) {
    faces.insert(face);
    return 1.f;
  });
  return faces;
}

Faces met_by_embree(const TriangleTree& tree, const Vec3& a, const Vec3& b) {
  Faces faces;
  tree.all(
      a, b, [](Index face, void* found) { static_cast<Faces*>(found)->insert(face); }, &faces);
  return faces;
}

}  // namespace

TEST(BoxTree, segments_meet_what_they_meet_for_embree) {
  const TriangleMesh mesh = shapes::sphere({100, 2, 3}, 0.05, 4);
  const BoxTree boxes(mesh);
  const TriangleTree tree(mesh);
  std::mt19937 generator(3);
  std::uniform_real_distribution<Real> uniform(-0.08, 0.08);
  const auto point = [&] { return Vec3(100 + uniform(generator), 2 + uniform(generator), 3 + uniform(generator)); };
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a = point(), b = point();
    const Faces faces = met_by_boxes(boxes, a, b);
    EXPECT_EQ(faces, met_by_embree(tree, a, b));
    met += static_cast<int>(faces.size());
  }
  EXPECT_GT(met, 1000);
}

TEST(BoxTree, a_segment_through_vertices_and_along_edges_finds_no_hole) {
  const TriangleMesh mesh = shapes::sphere({0, 0, 0}, 0.05, 3);
  const BoxTree boxes(mesh);
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    EXPECT_FALSE(met_by_boxes(boxes, Vec3::Zero(), 1.5 * mesh.vertices.col(v)).empty()) << v;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Vec3 middle = (mesh.vertices.col(mesh.faces(0, f)) + mesh.vertices.col(mesh.faces(1, f))) / 2;
    EXPECT_FALSE(met_by_boxes(boxes, Vec3::Zero(), 1.5 * middle).empty()) << f;
  }
}

TEST(BoxTree, asks_about_every_triangle_within_the_radius_and_few_beyond) {
  const TriangleMesh mesh = shapes::cylinder(0.02, 0.1, 40, 30);
  const BoxTree boxes(mesh);
  std::mt19937 generator(2);
  std::uniform_real_distribution<Real> uniform(-0.05, 0.1);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p(uniform(generator), uniform(generator), uniform(generator));
    Faces asked;
    boxes.near(p, 0.01f, [&](Index face) {
      EXPECT_TRUE(asked.insert(face).second);
      return 0.01f;
    });
    for (Index f = 0; f < mesh.face_count(); ++f) {
      const Vec3 a = mesh.vertices.col(mesh.faces(0, f)), b = mesh.vertices.col(mesh.faces(1, f)),
                 c = mesh.vertices.col(mesh.faces(2, f)), u = nearest_barycentric(p, a, b, c);
      const Real distance = (u[0] * a + u[1] * b + u[2] * c - p).norm();
      if (distance < 0.00999) {
        EXPECT_TRUE(asked.contains(f));
      }
      if (distance > 0.03) {
        EXPECT_FALSE(asked.contains(f));
      }
    }
  }
}

}  // namespace gracilis
