#include <gracilis/geometry/decimation.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/topology.hpp>

#include <gtest/gtest.h>
#include <shapes.hpp>

#include <algorithm>
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

TEST(Decimation, gives_flat_and_round_parts_triangles_of_one_size) {
  const TriangleMesh fine = shapes::sphere(Vec3::Zero(), 1, 5);
  const CoarseSurface coarse = decimate(fine, 600);
  const Points points = picked(fine.vertices, coarse.vertices);
  Real longest = 0, shortest = 1;
  for (const Eigen::Vector3i face : coarse.faces.colwise())
    for (int k = 0; k < 3; ++k) {
      const Real length = (points.col(face[k]) - points.col(face[(k + 1) % 3])).norm();
      longest = std::max(longest, length), shortest = std::min(shortest, length);
    }
  EXPECT_LT(longest / shortest, 5);
}

TEST(Decimation, edges_between_labels_stay_apart_and_every_vertex_knows_where_it_went) {
  const TriangleMesh fine = shapes::sphere(Vec3::Zero(), 1, 4);
  std::vector<Index> labels(static_cast<std::size_t>(fine.vertex_count()), -1);
  for (Index v = 0; v < fine.vertex_count(); ++v)
    if (fine.vertices(2, v) > 0.8) labels[static_cast<std::size_t>(v)] = 3;
  const CoarseSurface coarse = decimate(fine, 200, labels);
  ASSERT_EQ(coarse.went_to.size(), static_cast<std::size_t>(fine.vertex_count()));
  Index moved = 0;
  for (Index v = 0; v < fine.vertex_count(); ++v) {
    const Index end = coarse.vertices[static_cast<std::size_t>(coarse.went_to[static_cast<std::size_t>(v)])];
    EXPECT_EQ(labels[static_cast<std::size_t>(end)], labels[static_cast<std::size_t>(v)]);
    EXPECT_LT((fine.vertices.col(end) - fine.vertices.col(v)).norm(), 0.6);
    moved += end != v;
  }
  EXPECT_EQ(moved, fine.vertex_count() - static_cast<Index>(coarse.vertices.size()));
}

TEST(Decimation, an_open_border_stays_where_it_is) {
  TriangleMesh half = shapes::sphere(Vec3::Zero(), 1, 4);
  std::vector<Index> kept;
  for (Index f = 0; f < half.face_count(); ++f)
    if (half.vertices(2, half.faces(0, f)) > 0) kept.push_back(f);
  half.faces = half.faces(Eigen::all, kept).eval();
  std::set<Index> border;
  for (const MeshEdge& edge : build_topology(half.faces, half.vertex_count()).edges)
    if (edge.left < 0 || edge.right < 0) border.insert({edge.a, edge.b});
  ASSERT_GT(border.size(), 20u);
  const CoarseSurface coarse = decimate(half, 150);
  const std::set<Index> left(coarse.vertices.begin(), coarse.vertices.end());
  EXPECT_TRUE(std::includes(left.begin(), left.end(), border.begin(), border.end()));
}

TEST(Decimation, a_small_surface_stays_as_it_is) {
  const TriangleMesh small = shapes::sphere(Vec3::Zero(), 1, 1);
  const CoarseSurface coarse = decimate(small, 100);
  EXPECT_EQ(coarse.faces, small.faces);
  EXPECT_EQ(picked(small.vertices, coarse.vertices), small.vertices);
}
