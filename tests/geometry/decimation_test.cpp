#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/geometry/decimation.hpp>

#include <gtest/gtest.h>
#include <shapes.hpp>

#include <set>

using namespace gracilis;

TEST(Decimation, keeps_a_closed_surface_closed_and_nearly_its_volume) {
  const TriangleMesh fine = shapes::sphere(Vec3::Zero(), 1, 5);
  const CoarseSurface coarse = decimate(fine, 600);
  EXPECT_LT(coarse.vertices.size(), 700u);
  EXPECT_GT(coarse.vertices.size(), 400u);
  EXPECT_TRUE(is_closed(coarse.faces));
  const Points points = picked(fine.vertices, coarse.vertices);
  EXPECT_NEAR(enclosed_volume(points, coarse.faces) / enclosed_volume(fine.vertices, fine.faces), 1, 0.03);
}

TEST(Decimation, leaves_vertices_where_they_are) {
  const TriangleMesh fine = shapes::sphere(Vec3::Zero(), 1, 4);
  const CoarseSurface coarse = decimate(fine, 200);
  const std::set<Index> distinct(coarse.vertices.begin(), coarse.vertices.end());
  EXPECT_EQ(distinct.size(), coarse.vertices.size());
  EXPECT_GE(*distinct.begin(), 0);
  EXPECT_LT(*distinct.rbegin(), fine.vertex_count());
  // Faces connect neighbors: were the numbers mixed up, some would reach across the sphere.
  const Points points = picked(fine.vertices, coarse.vertices);
  for (const Eigen::Vector3i face : coarse.faces.colwise())
    EXPECT_LT((points.col(face[0]) - points.col(face[1])).norm(), 1.0);
}

TEST(Decimation, a_small_surface_stays_as_it_is) {
  const TriangleMesh small = shapes::sphere(Vec3::Zero(), 1, 1);
  const CoarseSurface coarse = decimate(small, 100);
  EXPECT_EQ(coarse.faces, small.faces);
  EXPECT_EQ(picked(small.vertices, coarse.vertices), small.vertices);
}
