#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/surface_repair.hpp>

#include "shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace gracilis {
namespace {

using shapes::box;
using shapes::mesh_of;
using shapes::sphere;

constexpr Real cm = 0.01;

Real volume(const TriangleMesh& mesh) { return enclosed_volume(mesh.vertices, mesh.faces); }

Index crossings(const TriangleMesh& mesh) {
  const std::array<const TriangleMesh*, 1> one = {&mesh};
  return static_cast<Index>(intersecting_faces(one).size());
}

void expect_solid(const TriangleMesh& mesh) {
  const MeshReport report = inspect_mesh(mesh);
  EXPECT_TRUE(report.is_closed());
  EXPECT_TRUE(report.is_manifold());
  EXPECT_TRUE(report.is_oriented());
  EXPECT_GT(report.volume, 0);
}

/// Two boxes that share the vertex (1, 1, 1) cm.
TriangleMesh boxes_joined_in_a_point() {
  TriangleMesh both = merged({box(Vec3::Zero(), Vec3::Ones() * cm), box(Vec3::Ones() * cm, Vec3::Ones() * 2 * cm)});
  for (Index& v : both.faces.reshaped())
    if (v == 8) v = 7;
  return both;
}

/// Two boxes that share the edge from (1, 1, 0) to (1, 1, 1) cm: four faces at it.
TriangleMesh boxes_joined_along_an_edge() {
  TriangleMesh both = merged({box(Vec3::Zero(), Vec3::Ones() * cm), box(Vec3(1, 1, 0) * cm, Vec3(2, 2, 1) * cm)});
  for (Index& v : both.faces.reshaped()) v = v == 8 ? 3 : v == 12 ? 7 : v;
  return both;
}

TEST(SurfaceRepair, a_sound_surface_comes_back_bit_for_bit) {
  const TriangleMesh ball = sphere(Vec3::Zero(), 2 * cm, 3);
  const FixedSurface fixed = fix_surface(ball, "ball");
  EXPECT_EQ(fixed.mesh.vertices, ball.vertices);
  EXPECT_EQ(fixed.mesh.faces, ball.faces);
  EXPECT_TRUE(fixed.repairs.empty());
}

TEST(SurfaceRepair, boxes_joined_in_a_point_become_two_pieces) {
  ASSERT_TRUE(inspect_mesh(boxes_joined_in_a_point()).pinched_vertices);
  const FixedSurface fixed = fix_surface(boxes_joined_in_a_point(), "boxes");
  expect_solid(fixed.mesh);
  EXPECT_EQ(fixed.mesh.face_count(), 24);
  EXPECT_NEAR(volume(fixed.mesh), 2 * cm * cm * cm, 1e-12);
  EXPECT_EQ(pieces_of(fixed.mesh).size(), 2u);
  EXPECT_THAT(fixed.repairs, testing::Not(testing::IsEmpty()));
}

TEST(SurfaceRepair, sheets_at_an_edge_with_four_faces_are_separated) {
  ASSERT_TRUE(inspect_mesh(boxes_joined_along_an_edge()).non_manifold_edges);
  const FixedSurface fixed = fix_surface(boxes_joined_along_an_edge(), "boxes");
  expect_solid(fixed.mesh);
  EXPECT_NEAR(volume(fixed.mesh), 2 * cm * cm * cm, 1e-12);
}

TEST(SurfaceRepair, a_flipped_face_is_turned) {
  TriangleMesh ball = sphere(Vec3::Zero(), 2 * cm, 2);
  std::swap(ball.faces(0, 5), ball.faces(1, 5));
  ASSERT_TRUE(inspect_mesh(ball).inconsistent_edges);
  const FixedSurface fixed = fix_surface(ball, "ball");
  expect_solid(fixed.mesh);
  EXPECT_EQ(fixed.mesh.face_count(), ball.face_count());
}

TEST(SurfaceRepair, a_surface_turned_inside_out_is_turned_back) {
  TriangleMesh ball = sphere(Vec3::Zero(), 2 * cm, 2);
  ball.faces.row(0).swap(ball.faces.row(1));
  ASSERT_LT(volume(ball), 0);
  expect_solid(fix_surface(ball, "ball").mesh);
}

TEST(SurfaceRepair, a_hole_is_filled_with_its_surroundings_shape) {
  const TriangleMesh ball = sphere(Vec3::Zero(), 2 * cm, 3);
  TriangleMesh open = ball;
  open.faces.conservativeResize(3, ball.face_count() - 12);
  ASSERT_TRUE(inspect_mesh(open).open_edges);
  const FixedSurface fixed = fix_surface(open, "ball");
  expect_solid(fixed.mesh);
  EXPECT_NEAR(volume(fixed.mesh) / volume(ball), 1, 0.01);
}

TEST(SurfaceRepair, triangles_of_their_own_grow_together) {
  const TriangleMesh ball = sphere(Vec3::Zero(), 2 * cm, 2);
  TriangleMesh soup;
  soup.vertices.resize(3, 3 * ball.face_count());
  soup.faces.resize(3, ball.face_count());
  for (Index i = 0; i < 3 * ball.face_count(); ++i) {
    soup.vertices.col(i) = ball.vertices.col(ball.faces(i % 3, i / 3));
    soup.faces(i % 3, i / 3) = i;
  }
  const FixedSurface fixed = fix_surface(soup, "soup");
  expect_solid(fixed.mesh);
  EXPECT_EQ(fixed.mesh.vertex_count(), ball.vertex_count());
}

TEST(SurfaceRepair, triangles_without_area_disappear) {
  TriangleMesh ball = sphere(Vec3::Zero(), 2 * cm, 2);
  ball.faces.conservativeResize(3, ball.face_count() + 1);
  ball.faces.rightCols(1) << 0, 0, 1;
  const FixedSurface fixed = fix_surface(ball, "ball");
  expect_solid(fixed.mesh);
  EXPECT_EQ(fixed.mesh.face_count(), ball.face_count() - 1);
}

TEST(SurfaceRepair, a_dent_pushed_through_the_other_side_is_removed) {
  TriangleMesh ball = sphere(Vec3::Zero(), 2 * cm, 3);
  Index top = 0;
  ball.vertices.row(2).maxCoeff(&top);
  ball.vertices(2, top) = -3 * cm;
  ASSERT_GT(crossings(ball), 0);
  const FixedSurface fixed = fix_surface(ball, "ball");
  expect_solid(fixed.mesh);
  EXPECT_EQ(crossings(fixed.mesh), 0);
}

TEST(SurfaceRepair, an_empty_surface_and_an_unbounded_one_are_refused_by_name) {
  const auto message_of = [](const TriangleMesh& mesh) {
    try {
      fix_surface(mesh, "liver.ply");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message_of({}), testing::AllOf(testing::HasSubstr("liver.ply"), testing::HasSubstr("no faces")));
  TriangleMesh ball = sphere(Vec3::Zero(), 2 * cm, 1);
  ball.vertices(0, 0) = std::numeric_limits<Real>::quiet_NaN();
  EXPECT_THAT(message_of(ball), testing::AllOf(testing::HasSubstr("liver.ply"), testing::HasSubstr("finite")));
}

TEST(SurfaceRepair, pieces_come_apart_and_together_again) {
  const TriangleMesh small = box(Vec3::Zero(), Vec3::Ones() * cm), large = sphere(Vec3(5, 0, 0) * cm, 2 * cm, 2);
  const TriangleMesh all = merged({small, large});
  EXPECT_EQ(all.face_count(), small.face_count() + large.face_count());
  const std::vector<TriangleMesh> pieces = pieces_of(all);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces[0].vertices, large.vertices);
  EXPECT_EQ(pieces[1].faces, small.faces);
}

// ---- The judge

TEST(IntersectingFaces, neighbors_do_not_count) {
  EXPECT_EQ(crossings(box(Vec3::Zero(), Vec3::Ones())), 0);
  EXPECT_EQ(crossings(sphere(Vec3::Zero(), 1, 3)), 0);
}

TEST(IntersectingFaces, overlapping_spheres_are_found_and_told_apart_from_self_intersections) {
  const TriangleMesh a = sphere(Vec3::Zero(), 1, 3), b = sphere(Vec3(1.5, 0, 0), 1, 3), c = sphere(Vec3(9, 0, 0), 1, 3);
  const std::array<const TriangleMesh*, 3> all = {&a, &b, &c};
  const std::vector<FacePair> pairs = intersecting_faces(all);
  ASSERT_FALSE(pairs.empty());
  for (const FacePair& pair : pairs) {
    EXPECT_EQ(pair.mesh_a, 0);
    EXPECT_EQ(pair.mesh_b, 1);
  }
}

TEST(IntersectingFaces, a_face_folded_flat_onto_its_neighbor_counts) {
  const TriangleMesh folded = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.5, 0}}, {{0, 1, 2}, {1, 0, 3}});
  const TriangleMesh flat = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, -0.5, 0}}, {{0, 1, 2}, {1, 0, 3}});
  EXPECT_EQ(crossings(folded), 1);
  EXPECT_EQ(crossings(flat), 0);
}

TEST(IntersectingFaces, one_that_shares_a_corner_and_cuts_the_opposite_side_counts) {
  const TriangleMesh cutting =
      mesh_of({{0, 0, 0}, {1, -1, 0}, {1, 1, 0}, {1, 0, -1}, {1, 0, 1}}, {{0, 1, 2}, {0, 3, 4}});
  EXPECT_EQ(crossings(cutting), 1);
}

}  // namespace
}  // namespace gracilis
