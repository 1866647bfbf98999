#include <gracilis/geometry/half_edges.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/topology.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

namespace gracilis {

TEST(Topology, a_closed_surface_of_genus_0_obeys_euler_and_has_two_sides_everywhere) {
  const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 1, 3);
  const MeshTopology topology = build_topology(ball.faces, ball.vertex_count());
  EXPECT_EQ(ball.vertex_count() - static_cast<Index>(topology.edges.size()) + ball.face_count(), 2);
  for (const MeshEdge& edge : topology.edges) {
    ASSERT_GE(edge.left, 0);
    ASSERT_GE(edge.right, 0);
    EXPECT_NE(edge.left_apex, edge.right_apex);
  }
  EXPECT_TRUE(is_closed(ball.faces));
}

TEST(Topology, an_open_edge_has_one_side_only) {
  const TriangleMesh triangle = shapes::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const MeshTopology topology = build_topology(triangle.faces, 3);
  ASSERT_EQ(topology.edges.size(), 3u);
  for (const MeshEdge& edge : topology.edges) EXPECT_EQ((edge.left < 0) + (edge.right < 0), 1);
  EXPECT_FALSE(is_closed(triangle.faces));
}

TEST(Topology, a_surface_with_a_flipped_triangle_is_not_closed) {
  TriangleMesh box = shapes::box(Vec3::Zero(), Vec3::Ones());
  ASSERT_TRUE(is_closed(box.faces));
  std::swap(box.faces(0, 5), box.faces(1, 5));
  EXPECT_FALSE(is_closed(box.faces));
}

TEST(Topology, half_edges_come_by_their_vertices_and_faces_whatever_the_faces_are) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> vertex(0, 30);
  Eigen::Matrix3Xi soup(3, 300);
  for (int& corner : soup.reshaped()) corner = vertex(random);
  const std::vector<HalfEdge> half_edges = sorted_half_edges(soup);
  const auto key = [](const HalfEdge& each) { return std::tie(each.low, each.high, each.face, each.forward); };
  EXPECT_TRUE(std::is_sorted(half_edges.begin(), half_edges.end(),
                             [&](const HalfEdge& l, const HalfEdge& r) { return key(l) < key(r); }));
  std::size_t expected = 0;
  for (Index f = 0; f < soup.cols(); ++f)
    for (int k = 0; k < 3; ++k) expected += soup(k, f) != soup((k + 1) % 3, f);
  EXPECT_EQ(half_edges.size(), expected);
  for (const HalfEdge& each : half_edges) {
    EXPECT_LT(each.low, each.high);
    Eigen::Vector3i corners(each.low, each.high, each.apex), face = soup.col(each.face);
    std::sort(corners.begin(), corners.end()), std::sort(face.begin(), face.end());
    EXPECT_EQ(corners, face);
  }
  EXPECT_TRUE(sorted_half_edges(Eigen::Matrix3Xi(3, 0)).empty());
}

TEST(Topology, a_face_that_names_a_vertex_twice_closes_nothing) {
  Eigen::Matrix3Xi faces(3, 1);
  faces << 0, 0, 1;
  EXPECT_FALSE(is_closed(faces));
}

TEST(Topology, breadth_first_order_is_a_permutation) {
  const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 1, 3);
  const MeshTopology topology = build_topology(ball.faces, ball.vertex_count());
  std::vector<Index> sorted = breadth_first_order(topology.stars);
  std::sort(sorted.begin(), sorted.end());
  ASSERT_EQ(static_cast<Index>(sorted.size()), ball.vertex_count());
  for (Index v = 0; v < ball.vertex_count(); ++v) ASSERT_EQ(sorted[static_cast<std::size_t>(v)], v);
}

TEST(Measures, volume_and_area_of_a_box_wherever_it_stands) {
  const Vec3 shift(100, -50, 20);
  const TriangleMesh box = shapes::box(shift, shift + Vec3(1, 2, 3));
  EXPECT_NEAR(enclosed_volume(box.vertices, box.faces), 6, 1e-9);
  EXPECT_NEAR(surface_area(box.vertices, box.faces), 22, 1e-9);
  EXPECT_NEAR(vertex_areas(box.vertices, box.faces).sum(), 22, 1e-9);
}

TEST(Measures, extents_and_lengths_are_those_of_the_corners_of_a_box) {
  const TriangleMesh box = shapes::box({1, 2, 3}, {2, 4, 6});
  EXPECT_EQ(bounding_box(box.vertices).min(), Vec3(1, 2, 3));
  EXPECT_EQ(bounding_box(box.vertices).max(), Vec3(2, 4, 6));
  EXPECT_NEAR(extent_of(box.vertices), std::sqrt(14.0) / 2, 1e-12) << "each corner half of a diagonal from the middle";
  const std::vector<MeshEdge> edges = build_topology(box.faces, 8).edges;
  ASSERT_EQ(edges.size(), 18u);
  const Real diagonals = 2 * (std::sqrt(5.0) + std::sqrt(10.0) + std::sqrt(13.0));
  EXPECT_NEAR(mean_edge_length(edges, box.vertices), (4 * (1 + 2 + 3) + diagonals) / 18, 1e-12);
  EXPECT_EQ(mean_edge_length({}, box.vertices), 0);
  EXPECT_EQ(enclosed_volume(Points(3, 0), Eigen::Matrix3Xi(3, 0)), 0);
  // Of an edge the faces on both sides count, or the only one.
  const TriangleMesh two = shapes::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, -4, 0}}, {{0, 1, 2}, {1, 0, 3}});
  for (const MeshEdge& edge : build_topology(two.faces, 4).edges) {
    const bool is_shared = edge.a == 0 && edge.b == 1, is_first = edge.a == 2 || edge.b == 2;
    EXPECT_NEAR(area_at(edge, two.vertices, two.faces), is_shared ? 3 : is_first ? 1 : 2, 1e-12);
  }
  const Eigen::VectorXd areas = vertex_areas(two.vertices, two.faces);
  EXPECT_LT((areas - Eigen::Vector4d(1, 1, 1.0 / 3, 2.0 / 3)).norm(), 1e-12) << "a third of each face to each corner";
}

}  // namespace gracilis
