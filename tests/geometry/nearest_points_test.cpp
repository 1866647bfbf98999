#include <gracilis/geometry/nearest_points.hpp>
#include <gracilis/geometry/vertex_normals.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <random>

namespace gracilis {

TEST(NearestPoints, all_within_a_reach_are_those_of_brute_force) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<Real> uniform(-1, 1);
  Points points(3, 500);
  for (Index i = 0; i < 500; ++i) points.col(i) = Vec3(uniform(generator), uniform(generator), uniform(generator));
  const NearestPoints tree(points);
  for (const Real reach : {0.1, 0.4, 5.0})
    for (Index i = 0; i < 500; i += 50) {
      std::vector<Index> expected;
      for (Index j = 0; j < 500; ++j)
        if ((points.col(i) - points.col(j)).norm() < reach) expected.push_back(j);
      EXPECT_EQ(tree.within(points.col(i), reach), expected);
    }
}

TEST(VertexNormals, those_of_a_sphere_lead_away_from_its_center) {
  TriangleMesh sphere = shapes::sphere(Vec3(1, 2, 3), 0.5, 3);
  const Points normals = vertex_normals(sphere.vertices, sphere.faces);
  for (Index v = 0; v < sphere.vertex_count(); ++v)
    EXPECT_LT((normals.col(v) - 2 * (sphere.vertices.col(v) - Vec3(1, 2, 3))).norm(), 0.06);
  sphere.vertices.conservativeResize(3, sphere.vertices.cols() + 1);
  EXPECT_EQ(Vec3(vertex_normals(sphere.vertices, sphere.faces).rightCols(1)), Vec3::Zero()) << "in no face";
}

}  // namespace gracilis
