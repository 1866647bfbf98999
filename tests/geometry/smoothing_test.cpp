#include <gracilis/geometry/smoothing.hpp>

#include <gracilis/geometry/cross_section.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/surface_samples.hpp>
#include <gracilis/geometry/surface_shape.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {
namespace {

/// A path of five vertices and one that nothing joins.
const VertexStars path{{0, 1, 3, 5, 7, 8, 8}, {1, 0, 2, 1, 3, 2, 4, 3}};

Points on_path() {
  Points points = Points::Zero(3, 6);
  points.row(0) << 0, 1, 2, 3, 4, 9;
  points.row(1) << 0, 0, 1, 0, 0, 5;
  return points;
}

}  // namespace

TEST(Smoothing, to_the_means_goes_by_factor_and_weight_all_at_once) {
  Points points = on_path();
  Eigen::VectorXd weights(6);
  weights << 0, 1, 0.5, 0, 1, 1;
  move_to_means(points, path, weights, 0.5);
  Points expected = on_path();
  expected(1, 1) = 0.25;  // half of the way to (0 + 1) / 2
  expected(1, 2) = 0.75;  // a quarter of the way to 0
  expected(0, 4) = 3.5;
  EXPECT_LT((points - expected).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(Smoothing, a_round_goes_forth_by_a_half_and_back_by_a_little_more) {
  Points points = on_path(), by_hand = on_path();
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(6);
  smooth_points(points, path, 2);
  for (int step = 0; step < 4; ++step) move_to_means(by_hand, path, all, step % 2 == 0 ? 0.5 : -0.53);
  EXPECT_LT((points - by_hand).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_EQ(points.col(5), on_path().col(5)) << "without neighbors";
  Points untouched = on_path();
  smooth_points(untouched, path, 0);
  EXPECT_EQ(untouched, on_path());
}

TEST(Smoothing, in_single_precision_is_the_same) {
  Points points = on_path();
  smooth_points(points, path, 3);
  Eigen::Matrix4Xf drawn = Eigen::Matrix4Xf::Zero(4, 6);
  drawn.topRows(3) = on_path().cast<float>();
  smooth_points(drawn, path, 3);
  EXPECT_LT((drawn.topRows(3).cast<Real>() - points).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Smoothing, what_went_too_far_comes_back_on_its_way) {
  const Points start = on_path();
  Points points = start;
  points.col(1) += Vec3(3, 0, 4);
  points.col(2) += Vec3(0.6, 0, 0.8);
  keep_within(2, start, points);
  EXPECT_LT((points.col(1) - start.col(1) - Vec3(1.2, 0, 1.6)).norm(), 1e-14);
  EXPECT_LT((points.col(2) - start.col(2) - Vec3(0.6, 0, 0.8)).norm(), 1e-15);
}

TEST(SurfaceShape, tells_of_a_spike_how_far_it_stands_out_and_of_the_body_how_thick_it_is) {
  TriangleMesh tube = shapes::cylinder(0.01, 0.1, 24, 40);
  const MeshTopology topology = build_topology(tube.faces, tube.vertex_count());
  const SurfaceShape smooth = shape_of(tube, topology);
  const std::size_t v = 24 * 20 + 5;
  EXPECT_NEAR(smooth.thickness[v], 0.02, 2e-4);
  EXPECT_NEAR(smooth.mean_edge, mean_edge_length(topology.edges, tube.vertices), 1e-15);
  // Of the six neighbors two lie beside it on its ring, two on the rings above and below, each beside one of these.
  Real mean_edge = 0;
  for (Index i = topology.stars.offsets[v]; i < topology.stars.offsets[v + 1]; ++i)
    mean_edge += (tube.vertices.col(topology.stars.neighbors[static_cast<std::size_t>(i)]) -
                  tube.vertices.col(static_cast<Index>(v)))
                     .norm() /
                 6;
  EXPECT_NEAR(smooth.reach[v], mean_edge, 1e-12);
  const Vec3 outward = Vec3(tube.vertices(0, v), tube.vertices(1, v), 0).normalized();
  tube.vertices.col(static_cast<Index>(v)) += 0.004 * outward;
  const SurfaceShape spiky = shape_of(tube, topology);
  EXPECT_NEAR(spiky.apart[v], 0.004 + smooth.apart[v], 1e-6);
  EXPECT_LT((from_neighbors(topology.stars, static_cast<Index>(v), tube.vertices).normalized() - outward).norm(), 0.1);
}

TEST(SurfaceShape, a_short_edge_counts_as_half_a_mean_one_and_a_vertex_alone_stands_nowhere) {
  TriangleMesh mesh = shapes::both(shapes::box({0, 0, 0}, {1, 1, 1}), shapes::box({5, 5, 5}, {5.01, 5.01, 5.01}));
  Points more(3, 17);
  more << mesh.vertices, Vec3(9, 9, 9);
  mesh.vertices = more;
  const SurfaceShape shape = shape_of(mesh, build_topology(mesh.faces, 17));
  for (std::size_t v = 8; v < 17; ++v) EXPECT_NEAR(shape.reach[v], shape.mean_edge / 2, 1e-15) << v;
  EXPECT_EQ(shape.apart[16], 0);
  EXPECT_EQ(shape.thickness[16], 0);
}

TEST(CrossSection, of_a_box_is_that_of_its_sides_and_of_two_that_of_the_nearer_one) {
  const TriangleMesh boxes = shapes::both(shapes::box({0, 0, 0}, {2, 3, 4}), shapes::box({10, 0, 0}, {15, 1, 4}));
  const MeshTopology topology = build_topology(boxes.faces, boxes.vertex_count());
  EXPECT_NEAR(cross_section_area(boxes, topology, {1, 1, 1.3}, Vec3::UnitZ()), 6, 1e-9);
  EXPECT_NEAR(cross_section_area(boxes, topology, {9, 1, 1.3}, -Vec3::UnitZ()), 5, 1e-9);
  const Vec3 tilted = Vec3(0, 0.6, 0.8);
  EXPECT_NEAR(cross_section_area(boxes, topology, {1, 1.4, 2.1}, tilted), 6 / 0.8, 1e-9);
  EXPECT_EQ(cross_section_area(boxes, topology, {1, 1, 5}, Vec3::UnitZ()), 0);
}

TEST(SurfaceSamples, are_the_vertices_with_their_normals_and_areas_without_those_that_no_face_names) {
  TriangleMesh ball = shapes::sphere({1, 2, 3}, 2, 3);
  const Index count = ball.vertex_count();
  Points more(3, count + 1);
  more << ball.vertices, Vec3(9, 9, 9);
  ball.vertices = more;
  const SurfaceSamples samples = surface_samples(ball);
  ASSERT_EQ(samples.count(), count);
  EXPECT_NEAR(samples.areas.sum(), surface_area(ball.vertices, ball.faces), 1e-9);
  for (Index i = 0; i < count; ++i)
    EXPECT_GT(samples.normals.col(i).dot((samples.points.col(i) - Vec3(1, 2, 3)) / 2), 0.99);
  const SurfaceSamples upper = samples.kept([&](Index i) { return samples.points(2, i) > 3; });
  EXPECT_LT(upper.count(), count);
  EXPECT_GT(upper.points.row(2).minCoeff(), 3);
}

}  // namespace gracilis
