#include <gracilis/geometry/shortest_paths.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gracilis {

static EdgeGraph graph_of(const TriangleMesh& mesh) {
  return length_graph(mesh.vertices, build_topology(mesh.faces, mesh.vertex_count()));
}

TEST(ShortestPath, on_a_sphere_is_no_shorter_than_the_great_circle_and_little_longer) {
  const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 1, 5);
  const EdgeGraph graph = graph_of(ball);
  Real worst = 0;
  for (Index to = 1; to < ball.vertex_count(); to += 97) {
    const std::vector<Index> path = shortest_path(graph, 0, to);
    ASSERT_EQ(path.front(), 0);
    ASSERT_EQ(path.back(), to);
    const Real geodesic = std::acos(std::clamp(ball.vertices.col(0).dot(ball.vertices.col(to)), -1.0, 1.0));
    const Real length = path_cost(graph, path);
    EXPECT_GT(length, geodesic * (1 - 1e-3)) << "edges are chords";
    if (geodesic > 0.2) worst = std::max(worst, length / geodesic);
  }
  // Worst across a corner of angle w, by 1 / cos(w/2); the octahedron's corners come near to 90 degrees.
  EXPECT_LT(worst, std::sqrt(2.0));
  EXPECT_GT(worst, 1.01) << "ways along edges are no geodesics";
}

TEST(ShortestPath, along_a_line_of_edges_is_the_geodesic_itself) {
  // The octahedron's equator stays a line of edges when it is subdivided.
  const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 1, 5);
  const EdgeGraph graph = graph_of(ball);
  EXPECT_NEAR(path_cost(graph, shortest_path(graph, 0, 1)), pi, 1e-3) << "from pole to pole";
  EXPECT_NEAR(path_cost(graph, shortest_path(graph, 0, 2)), pi / 2, 1e-3);
}

TEST(ShortestPath, between_a_vertex_and_itself_is_that_vertex_and_between_pieces_there_is_none) {
  const TriangleMesh two =
      shapes::both(shapes::box(Vec3::Zero(), Vec3::Ones()), shapes::box(Vec3::Constant(2), Vec3::Constant(3)));
  const EdgeGraph graph = graph_of(two);
  EXPECT_EQ(shortest_path(graph, 3, 3), std::vector<Index>{3});
  EXPECT_EQ(path_cost(graph, {3}), 0);
  EXPECT_TRUE(shortest_path(graph, 0, 9).empty());
}

TEST(EdgeDistance, is_the_way_along_edges_and_infinite_to_another_component) {
  const TriangleMesh one = shapes::box({0, 0, 0}, {1, 2, 3}), other = shapes::box({10, 0, 0}, {11, 2, 3});
  const TriangleMesh two = shapes::both(one, other);
  const Eigen::VectorXd distances = edge_distances(graph_of(two), {0});
  EXPECT_EQ(distances[0], 0);
  EXPECT_DOUBLE_EQ(distances[1], 1);
  EXPECT_DOUBLE_EQ(distances[2], 2);
  EXPECT_DOUBLE_EQ(distances[4], 3);
  for (Index v = 0; v < one.vertex_count(); ++v) {
    EXPECT_GE(distances[v], (two.vertices.col(v) - two.vertices.col(0)).norm() - 1e-12);
    EXPECT_TRUE(std::isinf(distances[one.vertex_count() + v]));
  }
}

}  // namespace gracilis
