#include <gracilis/geometry/mean_value_coordinates.hpp>

#include <gracilis/geometry/surface_binding.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <random>

namespace gracilis {
namespace {

/// A ball with random dents: closed, not convex.
TriangleMesh dented_ball(unsigned seed) {
  TriangleMesh mesh = shapes::sphere(Vec3(0.1, -0.2, 0.3), 0.05, 3);
  std::mt19937 random(seed);
  std::uniform_real_distribution<Real> factor(0.75, 1.25);
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    mesh.vertices.col(v) = Vec3(0.1, -0.2, 0.3) + factor(random) * (mesh.vertices.col(v) - Vec3(0.1, -0.2, 0.3));
  return mesh;
}

Points points_inside(Index count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> value(-0.018, 0.018);
  return Points::NullaryExpr(3, count, [&] { return value(random); }).colwise() + Vec3(0.1, -0.2, 0.3);
}

const Eigen::Matrix3d shear = (Eigen::Matrix3d() << 1.2, 0.3, -0.1, 0, 0.8, 0.4, 0.2, -0.5, 1.1).finished();
const Vec3 shift(0.3, -0.1, 0.05);

}  // namespace

TEST(MeanValueCoordinates, of_a_cube_reproduce_affine_maps) {
  const TriangleMesh cube = shapes::box(Vec3::Zero(), Vec3(1, 2, 3));
  const MeanValueCoordinates coordinates(cube);
  for (const Vec3& p : {Vec3(0.5, 1, 1.5), Vec3(0.01, 1.99, 0.2), Vec3(0.9, 0.3, 2.9), Vec3(1e-6, 0.4, 1)}) {
    const Eigen::VectorXd weights = coordinates.weights(p);
    EXPECT_NEAR(weights.sum(), 1, 1e-12);
    EXPECT_GE(weights.minCoeff(), 0) << "convex surface, point inside";
    const Points mapped = (shear * cube.vertices).colwise() + shift;
    EXPECT_NEAR((mapped * weights - (shear * p + shift)).norm(), 0, 1e-9);
  }
}

TEST(MeanValueCoordinates, of_the_middle_of_a_cube_are_the_same_at_opposite_corners) {
  const MeanValueCoordinates coordinates(shapes::box(-Vec3::Ones(), Vec3::Ones()));
  const Eigen::VectorXd weights = coordinates.weights(Vec3::Zero());
  // The box is triangulated alike on opposite sides.
  for (Index v = 0; v < 8; ++v) EXPECT_NEAR(weights[v], weights[7 - v], 1e-12);
  EXPECT_GT(weights.minCoeff(), 0.05);
  EXPECT_NEAR(weights.sum(), 1, 1e-12);
}

TEST(MeanValueCoordinates, of_random_surfaces_reproduce_affine_maps) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const TriangleMesh mesh = dented_ball(seed);
    const MeanValueCoordinates coordinates(mesh);
    const Points mapped = (shear * mesh.vertices).colwise() + shift, points = points_inside(20);
    for (Index i = 0; i < points.cols(); ++i)
      EXPECT_NEAR((mapped * coordinates.weights(points.col(i)) - (shear * points.col(i) + shift)).norm(), 0, 1e-9);
  }
}

TEST(MeanValueCoordinates, on_the_surface_are_those_of_the_vertex_edge_or_triangle) {
  const TriangleMesh cube = shapes::box(Vec3::Zero(), Vec3::Ones());
  const MeanValueCoordinates coordinates(cube);
  EXPECT_NEAR(coordinates.weights(Vec3(0, 0, 0))[0], 1, 1e-12) << "a vertex";
  const Eigen::VectorXd edge = coordinates.weights(Vec3(0.25, 0, 0));
  EXPECT_NEAR(edge[0], 0.75, 1e-9);
  EXPECT_NEAR(edge[1], 0.25, 1e-9);
  const Eigen::VectorXd face = coordinates.weights(Vec3(0.25, 0.25, 0));
  EXPECT_NEAR(face[0], 0.5, 1e-9);
  EXPECT_NEAR(face[1] + face[2], 0.5, 1e-9);
  EXPECT_NEAR((cube.vertices * face - Vec3(0.25, 0.25, 0)).norm(), 0, 1e-9);
}

TEST(MeanValueCoordinates, are_continuous_up_to_the_surface) {
  const TriangleMesh cube = shapes::box(Vec3::Zero(), Vec3::Ones());
  const MeanValueCoordinates coordinates(cube);
  for (const Vec3& p : {Vec3(0.3, 0.2, 0), Vec3(0.5, 0, 0), Vec3(0, 0, 0)}) {
    const Eigen::VectorXd on = coordinates.weights(p), near = coordinates.weights(p + Vec3(1e-6, 2e-6, 3e-6));
    EXPECT_NEAR((on - near).cwiseAbs().maxCoeff(), 0, 1e-4) << p.transpose();
  }
}

TEST(SurfaceBinding, follows_affine_maps_exactly_whatever_is_taken_together) {
  const TriangleMesh mesh = dented_ball(3);
  const Points points = points_inside(50);
  for (const Real openness : {0.0, 0.3, 1.0}) {
    const SurfaceBinding binding(mesh, points, openness);
    EXPECT_NEAR((binding.evaluate(mesh.vertices) - points).cwiseAbs().maxCoeff(), 0, 1e-12);
    const Points moved = binding.evaluate((shear * mesh.vertices).colwise() + shift);
    EXPECT_NEAR((moved - ((shear * points).colwise() + shift)).cwiseAbs().maxCoeff(), 0, 1e-9);
  }
}

TEST(SurfaceBinding, agrees_with_the_coordinates_and_errs_by_little_where_it_takes_vertices_together) {
  const TriangleMesh mesh = shapes::sphere(Vec3(0.1, -0.2, 0.3), 0.05, 5);
  const Points points = points_inside(50);
  Points bent = mesh.vertices;  // twisted and bulged by centimetres
  for (Index v = 0; v < bent.cols(); ++v) {
    const Vec3 x = mesh.vertices.col(v);
    bent.col(v) = Eigen::AngleAxisd(20 * (x.z() - 0.3), Vec3::UnitZ()) * x + Vec3(0, 5 * x.z() * x.z(), 0);
  }
  const MeanValueCoordinates coordinates(mesh);
  Points expected(3, points.cols());
  for (Index i = 0; i < points.cols(); ++i) expected.col(i) = bent * coordinates.weights(points.col(i));
  const SurfaceBinding exact(mesh, points, 0), sparse(mesh, points);
  EXPECT_NEAR((exact.evaluate(bent) - expected).cwiseAbs().maxCoeff(), 0, 1e-7) << "single precision";
  EXPECT_NEAR((sparse.evaluate(bent) - expected).cwiseAbs().maxCoeff(), 0, 1e-4);
  EXPECT_GT((expected - points).cwiseAbs().maxCoeff(), 0.05);
  EXPECT_LT(sparse.term_count(), exact.term_count() / 4);
}

}  // namespace gracilis
