#include <gracilis/geometry/box_mesh.hpp>
#include <gracilis/geometry/decimation.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/topology.hpp>

#include <gtest/gtest.h>
#include <shapes.hpp>

#include <algorithm>
#include <cmath>
#include <set>

using namespace gracilis;

namespace {

/// Area times squared distance to the planes of the faces around a vertex, and their area.
std::pair<Real, Real> cost_at(const TriangleMesh& mesh, Index vertex, const Vec3& place) {
  Real cost = 0, all = 0;
  for (const Eigen::Vector3i face : mesh.faces.colwise()) {
    if (!(face.array() == vertex).any()) continue;
    const Vec3 vector = area_vector(mesh.vertices, face);
    const Real area = vector.norm() / 2, away = vector.normalized().dot(place - mesh.vertices.col(face[0]));
    cost += area * away * away, all += area;
  }
  return {cost, all};
}

/// A ball with dents by chance.
TriangleMesh uneven_ball() {
  TriangleMesh ball = shapes::sphere(Vec3(0.3, -0.2, 0.5), 1, 2);
  for (Index v = 0; v < ball.vertex_count(); ++v)
    ball.vertices.col(v) += 0.03 * Vec3(std::sin(7 * v), std::cos(5 * v), std::sin(3 * v));
  return ball;
}

}  // namespace

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

TEST(Decimation, the_edge_that_costs_least_goes_first) {
  const TriangleMesh mesh = uneven_ball();
  const CoarseSurface coarse = decimate(mesh, mesh.vertex_count() - 1);
  ASSERT_EQ(static_cast<Index>(coarse.vertices.size()), mesh.vertex_count() - 1);
  Index gone = 0;
  while (coarse.vertices[static_cast<std::size_t>(coarse.went_to[static_cast<std::size_t>(gone)])] == gone) ++gone;
  const Index kept = coarse.vertices[static_cast<std::size_t>(coarse.went_to[static_cast<std::size_t>(gone)])];
  Real least = 1e9;
  std::pair<Index, Index> cheapest;
  for (const MeshEdge& edge : build_topology(mesh.faces, mesh.vertex_count()).edges)
    for (const auto& [a, b] : {std::pair(edge.a, edge.b), std::pair(edge.b, edge.a)}) {
      const Vec3 place = mesh.vertices.col(b);
      const auto [of_a, area_a] = cost_at(mesh, a, place);
      const auto [of_b, area_b] = cost_at(mesh, b, place);
      const Real cost = of_a + of_b + 1e-3 * (area_a + area_b) * (mesh.vertices.col(a) - place).squaredNorm();
      if (cost < least) least = cost, cheapest = {a, b};
    }
  EXPECT_EQ(std::pair(gone, kept), cheapest);
}

TEST(Decimation, corners_and_edges_of_a_box_stay_sharp) {
  const TriangleMesh fine = box_mesh(Vec3::Zero(), Vec3(1, 2, 3), {6, 12, 18});
  const CoarseSurface coarse = decimate(fine, 60);
  const Points points = picked(fine.vertices, coarse.vertices);
  EXPECT_LE(points.cols(), 60);
  EXPECT_NEAR(enclosed_volume(points, coarse.faces), 6, 1e-9) << "no corner and no edge is cut off";
}

TEST(Decimation, leaves_no_sliver_and_no_vertex_with_more_than_twelve_triangles) {
  const TriangleMesh fine = shapes::sphere(Vec3::Zero(), 1, 5);
  const CoarseSurface coarse = decimate(fine, 12);
  const Points points = picked(fine.vertices, coarse.vertices);
  EXPECT_TRUE(is_closed(coarse.faces));
  std::vector<int> around(coarse.vertices.size(), 0);
  for (const Eigen::Vector3i face : coarse.faces.colwise()) {
    const Vec3 a = points.col(face[0]), b = points.col(face[1]), c = points.col(face[2]);
    const Real sides = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
    EXPECT_GE(2 * std::sqrt(3.0) * (b - a).cross(c - a).norm() / sides, 0.2 - 1e-12);
    for (const Index corner : face) ++around[static_cast<std::size_t>(corner)];
  }
  EXPECT_LE(*std::max_element(around.begin(), around.end()), 12);
}
