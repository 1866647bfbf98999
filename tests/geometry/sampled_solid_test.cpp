#include <gracilis/geometry/surface_extraction.hpp>
#include <gracilis/geometry/surface_remeshing.hpp>
#include <gracilis/geometry/topology.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace gracilis {
namespace {

/// Any function at the nodes of a grid, its box from -10 to 10 mm in x, 12 in y, 14 in z about the origin.
SampledSolid sampled(const std::function<Real(const Vec3&)>& value, Real step) {
  SampledSolid grid;
  grid.origin = Vec3(-0.01, -0.012, -0.014), grid.step = step;
  grid.nodes = (Vec3(0.02, 0.024, 0.028) / step).array().round().cast<int>() + 1;
  for (Index i = 0; i < grid.node_count(); ++i) grid.values.push_back(value(grid.node(i)));
  return grid;
}

/// Has x y z alone and every product of two and three of them, in millimeters.
Real trilinear(const Vec3& p) {
  const Real x = 1000 * p.x(), y = 1000 * p.y(), z = 1000 * p.z();
  return 1 + 2 * x - 3 * y + 4 * z + 0.5 * x * y - 0.7 * y * z + 0.3 * z * x + 0.11 * x * y * z;
}

}  // namespace

TEST(SampledSolid, nodes_go_along_x_first_then_y_then_z) {
  SampledSolid grid;
  grid.origin = Vec3(1, 2, 3), grid.step = 0.5, grid.nodes = {4, 3, 2};
  EXPECT_EQ(grid.node_count(), 24);
  EXPECT_EQ(grid.node(0), Vec3(1, 2, 3));
  EXPECT_EQ(grid.node(3), Vec3(2.5, 2, 3));
  EXPECT_EQ(grid.node(4), Vec3(1, 2.5, 3));
  EXPECT_EQ(grid.node(23), Vec3(2.5, 3, 3.5));
}

TEST(SampledSolid, a_margin_of_two_steps_at_least_surrounds_the_bounds) {
  const ImplicitSolid solid{[](const Vec3&) { return 1.0; }, {Vec3(0, 0.1, 0.2), Vec3(0.01, 0.125, 0.2299)}};
  const SampledSolid grid = sample(solid, 0.01);
  EXPECT_LT((grid.origin - Vec3(-0.02, 0.08, 0.18)).norm(), 1e-15);
  EXPECT_EQ(grid.nodes, Eigen::Vector3i(6, 8, 8));
  const Vec3 last = grid.node(grid.node_count() - 1);
  EXPECT_TRUE((last.array() >= solid.bounds.max().array() + 0.02 - 1e-12).all());
}

TEST(SampledSolid, every_node_within_two_steps_of_the_surface_has_the_solid_s_own_value) {
  // Shifted against the blocks of nodes in many ways, so that the surface passes each of their sides.
  for (int shift = 0; shift < 12; ++shift) {
    const Vec3 center = 0.0007 * shift * Vec3(1, 0.7, -0.4);
    const ImplicitSolid solid{[=](const Vec3& p) { return (p - center).norm() - 0.02; },
                              {Vec3::Constant(-0.04), Vec3::Constant(0.04)}};
    const SampledSolid grid = sample(solid, 0.001);
    for (Index i = 0; i < grid.node_count(); ++i) {
      const Real exact = solid.distance(grid.node(i)), value = grid.values[static_cast<std::size_t>(i)];
      if (std::abs(exact) < 0.002) {
        ASSERT_EQ(value, exact);
      }
      ASSERT_LE(std::abs(value), std::abs(exact) + 1e-12);
      ASSERT_EQ(value < 0, exact < 0);
    }
  }
}

TEST(SampledSolid, interpolation_and_its_gradient_are_exact_for_what_is_linear_in_each_direction) {
  const SampledSolid grid = sampled(trilinear, 0.002);
  for (const Vec3& p : {Vec3(0.0013, -0.0041, 0.0077), Vec3(-0.0099, 0.0111, -0.0135), Vec3(0.004, 0.002, -0.006),
                        Vec3(0.0095, 0.0119, 0.0139)}) {
    Vec3 gradient;
    EXPECT_NEAR(interpolate(grid, p, &gradient), trilinear(p), 1e-10);
    EXPECT_EQ(interpolate(grid, p), interpolate(grid, p, &gradient));
    for (int k = 0; k < 3; ++k) {
      const Vec3 by = 1e-6 * Vec3::Unit(k);
      EXPECT_NEAR(gradient[k], (trilinear(p + by) - trilinear(p - by)) / 2e-6, 1e-5) << k;
    }
  }
}

TEST(SampledSolid, beyond_the_grid_the_border_answers) {
  const SampledSolid grid = sampled(trilinear, 0.002);
  const Vec3 high(0.01, 0.012, 0.014);
  EXPECT_NEAR(interpolate(grid, {0.5, 0.001, 0.002}), trilinear({0.01, 0.001, 0.002}), 1e-10);
  EXPECT_NEAR(interpolate(grid, {0.003, -1, 0.002}), trilinear({0.003, -0.012, 0.002}), 1e-10);
  EXPECT_NEAR(interpolate(grid, {1, 1, 1}), trilinear(high), 1e-10);
  EXPECT_NEAR(interpolate(grid, {-1, -1, -1}), trilinear(-high), 1e-10);
}

TEST(ProjectionToSurface, goes_along_the_gradient_to_zero) {
  TriangleMesh mesh = shapes::mesh_of({{0.001, 0.002, 0.0015}, {-0.002, 0.001, -0.0012}}, {});
  project_to_surface(mesh, sampled([](const Vec3& p) { return 2 * (p.z() - 0.0005); }, 0.002));
  EXPECT_LT((mesh.vertices - shapes::mesh_of({{0.001, 0.002, 0.0005}, {-0.002, 0.001, 0.0005}}, {}).vertices).norm(),
            1e-12);
}

TEST(ProjectionToSurface, moves_by_a_step_at_most_and_slowly_where_the_gradient_is_flat) {
  TriangleMesh far = shapes::mesh_of({{0.001, 0.002, 0.01}, {0, 0, -0.0075}}, {});
  project_to_surface(far, sampled([](const Vec3& p) { return p.z(); }, 0.002));
  EXPECT_LT((far.vertices.col(0) - Vec3(0.001, 0.002, 0.008)).norm(), 1e-12);
  EXPECT_LT((far.vertices.col(1) - Vec3(0, 0, -0.0055)).norm(), 1e-12);
  // A tenth of a distance's gradient counts as half of one: each of four moves takes 0.1² / 0.25 of the way.
  TriangleMesh flat = shapes::mesh_of({{0, 0, 0.004}}, {});
  project_to_surface(flat, sampled([](const Vec3& p) { return 0.1 * p.z(); }, 0.002));
  EXPECT_NEAR(flat.vertices(2, 0), 0.004 * std::pow(0.96, 4), 1e-12);
}

TEST(Remeshing, is_as_even_on_an_ellipsoid_and_from_whatever_mesh_it_begins) {
  const ImplicitSolid solid = ellipsoid(Vec3::Zero(), {0.03, 0.02, 0.015});
  const SampledSolid grid = sample(solid, 0.001);
  TriangleMesh coarse = shapes::sphere(Vec3::Zero(), 1, 2), fine = shapes::sphere(Vec3::Zero(), 1, 5);
  for (TriangleMesh* mesh : {&coarse, &fine}) mesh->vertices = Vec3(0.03, 0.02, 0.015).asDiagonal() * mesh->vertices;
  for (const TriangleMesh& from : {coarse, fine}) {
    const TriangleMesh mesh = remesh(from, grid, 0.003);
    ASSERT_TRUE(is_closed(mesh.faces));
    const MeshTopology topology = build_topology(mesh.faces, mesh.vertex_count());
    EXPECT_EQ(mesh.vertex_count() - static_cast<Index>(topology.edges.size()) + mesh.face_count(), 2);
    Real shortest = 1, longest = 0;
    for (const MeshEdge& edge : topology.edges) {
      const Real length = (mesh.vertices.col(edge.a) - mesh.vertices.col(edge.b)).norm();
      shortest = std::min(shortest, length), longest = std::max(longest, length);
    }
    // Four fifths to four thirds of what is asked for, and what one more round of moving makes of it.
    EXPECT_GT(shortest, 0.0018);
    EXPECT_LT(longest, 0.0045);
    Index six = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const auto at = static_cast<std::size_t>(v);
      const Index neighbors = topology.stars.offsets[at + 1] - topology.stars.offsets[at];
      EXPECT_GE(neighbors, 4);
      EXPECT_LE(neighbors, 8);
      six += neighbors == 6;
      EXPECT_NEAR(solid.distance(mesh.vertices.col(v)), 0, 5e-5);
    }
    EXPECT_GT(six, mesh.vertex_count() * 6 / 10) << "flips bring most vertices to six neighbors";
  }
}

}  // namespace gracilis
