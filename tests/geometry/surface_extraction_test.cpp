#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/implicit_surface.hpp>
#include <gracilis/geometry/implicit_surface_spline.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/surface_extraction.hpp>
#include <gracilis/geometry/surface_remeshing.hpp>
#include <gracilis/geometry/topology.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gracilis {
namespace {

ImplicitSolid torus(Real major, Real minor) {
  const Vec3 half(major + minor, major + minor, minor);
  return {[=](const Vec3& p) { return std::hypot(std::hypot(p.x(), p.y()) - major, p.z()) - minor; }, {-half, half}};
}

int euler_characteristic(const TriangleMesh& mesh) {
  return mesh.vertex_count() - static_cast<int>(build_topology(mesh.faces, mesh.vertex_count()).edges.size()) +
         mesh.face_count();
}

/// Every vertex's faces form one ring: as many faces as neighbors.
bool is_manifold_at_every_vertex(const TriangleMesh& mesh) {
  const MeshTopology topology = build_topology(mesh.faces, mesh.vertex_count());
  std::vector<int> faces(mesh.vertex_count(), 0);
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (int c = 0; c < 3; ++c) ++faces[mesh.faces(c, f)];
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (faces[v] != topology.stars.offsets[v + 1] - topology.stars.offsets[v]) return false;
  return true;
}

struct EdgeLengths {
  Real shortest = 1e9, longest = 0, mean = 0;
};

EdgeLengths edge_lengths(const TriangleMesh& mesh) {
  EdgeLengths result;
  const auto edges = build_topology(mesh.faces, mesh.vertex_count()).edges;
  for (const MeshEdge& e : edges) {
    const Real length = (mesh.vertices.col(e.a) - mesh.vertices.col(e.b)).norm();
    result.shortest = std::min(result.shortest, length);
    result.longest = std::max(result.longest, length);
    result.mean += length / static_cast<Real>(edges.size());
  }
  return result;
}

Real smallest_angle(const TriangleMesh& mesh) {
  Real smallest = pi;
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (int c = 0; c < 3; ++c) {
      const Vec3 a = mesh.vertices.col(mesh.faces(c, f)), b = mesh.vertices.col(mesh.faces((c + 1) % 3, f)),
                 d = mesh.vertices.col(mesh.faces((c + 2) % 3, f));
      smallest = std::min(smallest, std::acos(std::clamp((b - a).normalized().dot((d - a).normalized()), -1.0, 1.0)));
    }
  return smallest;
}

TEST(SurfaceExtraction, a_ball_becomes_a_closed_outward_sphere_of_its_volume) {
  const SampledSolid grid = sample(ball({0.01, -0.02, 0.03}, 0.02), 0.001);
  const TriangleMesh mesh = extract_surface(grid);
  ASSERT_GT(mesh.face_count(), 1000);
  EXPECT_TRUE(is_closed(mesh.faces));
  EXPECT_TRUE(is_manifold_at_every_vertex(mesh));
  EXPECT_EQ(euler_characteristic(mesh), 2);
  const Real volume = 4 * pi / 3 * std::pow(0.02, 3);
  EXPECT_NEAR(enclosed_volume(mesh.vertices, mesh.faces), volume, 0.005 * volume);
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    EXPECT_NEAR((mesh.vertices.col(v) - Vec3(0.01, -0.02, 0.03)).norm(), 0.02, 0.0001);
}

TEST(SurfaceExtraction, a_torus_keeps_its_hole) {
  const TriangleMesh mesh = mesh_solid(torus(0.03, 0.01), 0.0015, 0.003);
  EXPECT_TRUE(is_closed(mesh.faces));
  EXPECT_TRUE(is_manifold_at_every_vertex(mesh));
  EXPECT_EQ(euler_characteristic(mesh), 0);
  const Real volume = 2 * pi * pi * 0.03 * 0.01 * 0.01;
  EXPECT_NEAR(enclosed_volume(mesh.vertices, mesh.faces), volume, 0.03 * volume);
}

TEST(SurfaceExtraction, random_values_give_a_closed_manifold_whatever_the_ambiguities) {
  SampledSolid grid;
  grid.step = 1;
  grid.nodes = {9, 9, 9};
  grid.values.assign(grid.node_count(), 1);
  unsigned state = 7;
  for (Index i = 0; i < grid.node_count(); ++i) {
    const Vec3 node = grid.node(i);
    state = state * 1664525u + 1013904223u;
    if (node.minCoeff() > 0.5 && node.maxCoeff() < 7.5) grid.values[i] = (state >> 8) / Real(1 << 23) - 1;
  }
  const TriangleMesh mesh = extract_surface(grid);
  ASSERT_GT(mesh.face_count(), 500);
  EXPECT_TRUE(is_closed(mesh.faces));
  EXPECT_TRUE(is_manifold_at_every_vertex(mesh));
}

TEST(SurfaceExtraction, zeros_on_nodes_make_no_hole) {
  const Vec3 half = Vec3::Constant(3);
  const ImplicitSolid cube{[](const Vec3& p) { return p.cwiseAbs().maxCoeff() - 3; }, {-half, half}};
  const TriangleMesh mesh = extract_surface(sample(cube, 1));
  EXPECT_TRUE(is_closed(mesh.faces));
  EXPECT_EQ(euler_characteristic(mesh), 2);
  // The twelve edges are cut off across one cell.
  EXPECT_NEAR(enclosed_volume(mesh.vertices, mesh.faces), 6 * 6 * 6 - 12 * 6 * 0.5 * 0.5, 3);
}

TEST(SurfaceExtraction, nothing_inside_gives_an_empty_mesh) {
  const ImplicitSolid nothing{[](const Vec3&) { return 1.0; }, {Vec3::Zero(), Vec3::Ones()}};
  const TriangleMesh mesh = extract_surface(sample(nothing, 0.25));
  EXPECT_EQ(mesh.face_count(), 0);
  EXPECT_EQ(largest_component(mesh).vertex_count(), 0);
}

TEST(SurfaceExtraction, sampling_skips_far_nodes_but_keeps_their_sign) {
  const ImplicitSolid solid = ball(Vec3::Zero(), 0.05);
  const SampledSolid grid = sample(solid, 0.002);
  for (Index i = 0; i < grid.node_count(); ++i) {
    const Real exact = solid.distance(grid.node(i));
    ASSERT_EQ(grid.values[i] < 0, exact < 0);
    ASSERT_LE(std::abs(grid.values[i]), std::abs(exact) + 1e-12);
    if (std::abs(exact) < 0.003) {
      ASSERT_EQ(grid.values[i], exact);
    }
  }
}

TEST(SurfaceExtraction, the_same_bits_for_any_number_of_threads) {
  const ImplicitSolid solid =
      smooth_union({ball({0, 0, 0}, 0.02), thick_curve({{{0, 0, 0}, 0.01}, {{0.05, 0, 0.01}, 0.006}})}, 0.01);
  TriangleMesh one;
  {
    const ThreadLimit limit(1);
    one = mesh_solid(solid, 0.002, 0.004);
  }
  const TriangleMesh many = mesh_solid(solid, 0.002, 0.004);
  EXPECT_EQ(one.vertices, many.vertices);
  EXPECT_EQ(one.faces, many.faces);
}

TEST(SurfaceExtraction, interpolation_is_exact_for_linear_values_with_their_gradient) {
  const ImplicitSolid slope{[](const Vec3& p) { return p.dot(Vec3(0.3, -0.5, 0.8)) + 0.001; },
                            {Vec3::Constant(-0.01), Vec3::Constant(0.01)}};
  const SampledSolid grid = sample(slope, 0.01);
  Vec3 gradient;
  const Vec3 point(0.0013, -0.0041, 0.0077);
  EXPECT_NEAR(interpolate(grid, point, &gradient), slope.distance(point), 1e-12);
  EXPECT_LT((gradient - Vec3(0.3, -0.5, 0.8)).norm(), 1e-9);
}

TEST(SurfaceExtraction, the_largest_component_is_kept_whole) {
  const ImplicitSolid two = smooth_union({ball({0, 0, 0}, 0.01), ball({0.05, 0, 0}, 0.02)}, 0.001);
  const TriangleMesh mesh = extract_surface(sample(two, 0.002));
  EXPECT_EQ(euler_characteristic(mesh), 4);
  const TriangleMesh large = largest_component(mesh);
  EXPECT_EQ(euler_characteristic(large), 2);
  EXPECT_GT(large.vertices.row(0).minCoeff(), 0.02);
  const Real volume = 4 * pi / 3 * std::pow(0.02, 3);
  EXPECT_NEAR(enclosed_volume(large.vertices, large.faces), volume, 0.02 * volume);
}

TEST(Remeshing, edges_become_even_and_no_triangle_is_a_sliver) {
  for (const ImplicitSolid& solid : {ball(Vec3::Zero(), 0.03), torus(0.04, 0.015)}) {
    const SampledSolid grid = sample(solid, 0.002);
    const TriangleMesh rough = extract_surface(grid);
    EXPECT_LT(smallest_angle(rough), radians(5));
    const TriangleMesh mesh = remesh(rough, grid, 0.005);
    EXPECT_TRUE(is_closed(mesh.faces));
    EXPECT_TRUE(is_manifold_at_every_vertex(mesh));
    EXPECT_EQ(euler_characteristic(mesh), euler_characteristic(rough));
    const EdgeLengths lengths = edge_lengths(mesh);
    EXPECT_NEAR(lengths.mean, 0.005, 0.0005);
    EXPECT_GT(lengths.shortest, 0.0025);
    EXPECT_LT(lengths.longest, 0.008);
    EXPECT_GT(smallest_angle(mesh), radians(28));
    for (Index v = 0; v < mesh.vertex_count(); ++v) EXPECT_NEAR(solid.distance(mesh.vertices.col(v)), 0, 0.0002);
  }
}

TEST(Remeshing, a_thin_plate_survives_edges_longer_than_its_thickness) {
  ThickNet plate{2, 2, {{{0, 0, 0}, 0.002}, {{0.06, 0, 0}, 0.002}, {{0, 0.06, 0}, 0.002}, {{0.06, 0.06, 0}, 0.002}}};
  const TriangleMesh mesh = mesh_solid(thick_sheet(plate), 0.0015, 0.006);
  EXPECT_TRUE(is_closed(mesh.faces));
  EXPECT_TRUE(is_manifold_at_every_vertex(mesh));
  EXPECT_EQ(euler_characteristic(mesh), 2);
  // Triangles longer than the plate is thick cut its rim off, but nothing else.
  EXPECT_GT(enclosed_volume(mesh.vertices, mesh.faces), 0.05 * 0.05 * 0.004);
}

TEST(ImplicitSolid, a_smooth_minimum_is_the_minimum_away_from_the_blend) {
  EXPECT_EQ(smooth_minimum(0.1, 0.5, 0.2), 0.1);
  EXPECT_EQ(smooth_minimum(0.5, 0.1, 0.2), 0.1);
  EXPECT_DOUBLE_EQ(smooth_minimum(0.3, 0.3, 0.2), 0.25);
  EXPECT_EQ(smooth_minimum(0.3, 0.3, 0), 0.3);
  EXPECT_DOUBLE_EQ(smooth_maximum(0.3, 0.3, 0.2), 0.35);
}

TEST(ImplicitSolid, a_difference_excludes_what_was_removed) {
  const ImplicitSolid cup = smooth_difference(ball(Vec3::Zero(), 0.03), ball({0, 0, 0.02}, 0.02), 0.002);
  EXPECT_LT(cup.distance({0, 0, -0.02}), 0);
  EXPECT_GT(cup.distance({0, 0, 0.01}), 0);
  EXPECT_NEAR(cup.distance({0, 0, -0.04}), 0.01, 1e-12);
}

TEST(ImplicitSolid, far_away_it_never_answers_with_more_than_the_distance) {
  const ImplicitSolid curve = thick_curve({{{0, 0, 0}, 0.01}, {{0.1, 0, 0}, 0.01}});
  const ImplicitSolid whole = smooth_union({curve, ball({0, 0.1, 0}, 0.02)}, 0.008);
  for (Real y = -0.2; y < 0.3; y += 0.01) {
    const Vec3 p(0.05, y, 0.02);
    const Real exact = std::min(std::hypot(y, 0.02) - 0.01, (p - Vec3(0, 0.1, 0)).norm() - 0.02);
    EXPECT_LE(whole.distance(p), exact + 1e-12);
    EXPECT_EQ(whole.distance(p) > 0, exact > 0);
  }
}

TEST(ImplicitSolid, a_mirrored_solid_answers_as_the_original_across_the_plane) {
  const ImplicitSolid original = ball({0.01, 0.02, 0.03}, 0.02);
  const ImplicitSolid mirrored = mirrored_in_z(original, -0.05);
  EXPECT_DOUBLE_EQ(mirrored.distance({0.01, 0.02, -0.13}), -0.02);
  EXPECT_TRUE(mirrored.bounds.contains(Vec3(0.01, 0.02, -0.13)));
}

TEST(ThickSheet, a_flat_net_is_a_slab_with_its_parameters_along_rows_and_columns) {
  ThickNet net{3, 2, {}};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 2; ++column) net.points.push_back({Vec3(0.1 * column, 0.05 * row, 0), 0.004});
  const ThickSheet sheet(net);
  const ThickSheet::Nearest above = sheet.nearest({0.025, 0.075, 0.01});
  EXPECT_NEAR(above.distance, 0.006, 1e-12);
  EXPECT_NEAR(above.along, 0.75, 1e-9);
  EXPECT_NEAR(above.across, 0.25, 1e-9);
  EXPECT_NEAR(sheet.nearest({0.05, 0.05, 0}).distance, -0.004, 1e-12);
}

TEST(ThickSheet, a_spline_passes_through_its_points_and_keeps_straight_lines_straight) {
  const std::vector<ThickPoint> points = {{{0, 0, 0}, 0.01}, {{1, 0, 0}, 0.02}, {{2, 0, 0}, 0.03}};
  const std::vector<ThickPoint> cut = spline_through(points, 4);
  ASSERT_EQ(cut.size(), 9u);
  for (std::size_t i = 0; i < cut.size(); ++i) {
    EXPECT_NEAR((cut[i].point - Vec3(0.25 * static_cast<Real>(i), 0, 0)).norm(), 0, 1e-12);
    EXPECT_NEAR(cut[i].radius, 0.01 + 0.0025 * static_cast<Real>(i), 1e-12);
  }
}

TEST(ThickSheet, rows_that_meet_in_one_point_are_no_problem) {
  const ThickNet fan{2,
                     3,
                     {{{-0.02, 0, 0}, 0.003},
                      {{0, 0, 0}, 0.003},
                      {{0.02, 0, 0}, 0.003},
                      {{0, 0.05, 0}, 0.003},
                      {{0, 0.05, 0}, 0.003},
                      {{0, 0.05, 0}, 0.003}}};
  const ThickSheet sheet(fan);
  const ThickSheet::Nearest tip = sheet.nearest({0, 0.06, 0});
  EXPECT_NEAR(tip.distance, 0.007, 1e-9);
  EXPECT_NEAR(tip.along, 1, 1e-9);
}

}  // namespace
}  // namespace gracilis
