#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/surface_repair.hpp>

#include "shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

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

// ---- Surfaces as they come

TEST(SurfaceRepair, two_spheres_joined_in_a_point_become_two_closed_pieces) {
  const TriangleMesh left = sphere(Vec3(-2, 0, 0) * cm, 2 * cm, 2), right = sphere(Vec3(2, 0, 0) * cm, 2 * cm, 2);
  TriangleMesh both = merged({left, right});
  Index at_left = 0, at_right = 0;
  left.vertices.row(0).maxCoeff(&at_left);
  right.vertices.row(0).minCoeff(&at_right);
  for (Index& v : both.faces.reshaped())
    if (v == left.vertex_count() + at_right) v = at_left;
  ASSERT_TRUE(inspect_mesh(both).pinched_vertices);
  const FixedSurface fixed = fix_surface(both, "spheres");
  expect_solid(fixed.mesh);
  EXPECT_EQ(pieces_of(fixed.mesh).size(), 2u);
  EXPECT_NEAR(volume(fixed.mesh) / (2 * volume(left)), 1, 1e-9);
}

TEST(SurfaceRepair, a_shell_in_a_shell_is_dropped_whatever_its_side) {
  const TriangleMesh outer = sphere(Vec3::Zero(), 2 * cm, 3);
  for (const bool turned : {false, true}) {
    TriangleMesh inner = sphere(Vec3::Zero(), 1.5 * cm, 3);
    if (turned) inner.faces.row(0).swap(inner.faces.row(1));
    const FixedSurface fixed = fix_surface(merged({outer, inner}), "shells");
    EXPECT_EQ(fixed.mesh.face_count(), outer.face_count());
    EXPECT_NEAR(volume(fixed.mesh), volume(outer), 1e-12);
  }
}

TEST(SurfaceRepair, a_surface_that_is_there_twice_is_there_once) {
  const TriangleMesh ball = sphere(Vec3::Zero(), 2 * cm, 3);
  expect_solid(fix_surface(merged({ball, ball}), "ball").mesh);
  EXPECT_NEAR(volume(fix_surface(merged({ball, ball}), "ball").mesh), volume(ball), 1e-12);
}

TEST(SurfaceRepair, pieces_that_overlap_are_united) {
  const TriangleMesh left = box(Vec3(0, 0, 0) * cm, Vec3(2, 1, 1) * cm);
  const TriangleMesh right = box(Vec3(1, -0.5, 0.25) * cm, Vec3(3, 0.5, 0.75) * cm);
  const FixedSurface fixed = fix_surface(merged({left, right}), "boxes");
  expect_solid(fixed.mesh);
  EXPECT_EQ(pieces_of(fixed.mesh).size(), 1u);
  EXPECT_EQ(crossings(fixed.mesh), 0);
  EXPECT_NEAR(volume(fixed.mesh), 2.75e-6, 1e-9);  // 2 + 1 - 0.25 cm³
}

/// A tube along z, open at both ends, with a hole in its side.
TriangleMesh tube_with_a_hole() {
  constexpr int around = 24, along = 20;
  std::vector<Vec3> v;
  std::vector<Eigen::Vector3i> f;
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i < around; ++i) {
      const Real angle = 2 * M_PI * i / around;
      v.emplace_back(cm * std::cos(angle), cm * std::sin(angle), 0.3 * cm * j);
    }
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      if (i < 3 && j > 8 && j < 11) continue;
      const int a = j * around + i, b = j * around + (i + 1) % around;
      f.emplace_back(a, b, b + around);
      f.emplace_back(a, b + around, a + around);
    }
  return mesh_of(v, f);
}

TEST(SurfaceRepair, a_tube_with_a_hole_is_closed) {
  ASSERT_TRUE(inspect_mesh(tube_with_a_hole()).open_edges);
  const FixedSurface fixed = fix_surface(tube_with_a_hole(), "tube");
  expect_solid(fixed.mesh);
  const Real cylinder = M_PI * cm * cm * 6 * cm;
  EXPECT_NEAR(volume(fixed.mesh) / cylinder, 1,
              0.1);  // ends bulge a little, where a fair patch goes on as the tube came
}

TEST(SurfaceRepair, a_sheet_folded_onto_itself_encloses_what_a_thick_one_would_or_is_refused) {
  // A flat bag: both its sides are the same triangles.
  TriangleMesh flat = sphere(Vec3::Zero(), 2 * cm, 2);
  flat.vertices.row(2).setZero();
  EXPECT_THROW(fix_surface(flat, "bag"), InputError);
  // A sheet 2 mm thick whose one end is folded back through the other.
  TriangleMesh sheet = sphere(Vec3::Zero(), 2 * cm, 4);
  sheet.vertices.row(2) *= 0.05;
  for (auto p : sheet.vertices.colwise())
    if (p.x() > 0) p.x() *= -0.7, p.z() = -p.z() * 0.5;
  ASSERT_GT(crossings(sheet), 0);
  const FixedSurface fixed = fix_surface(sheet, "sheet");
  expect_solid(fixed.mesh);
  EXPECT_EQ(crossings(fixed.mesh), 0);
}

TEST(SurfaceRepair, what_encloses_nothing_is_refused_and_never_a_crash) {
  const TriangleMesh one = mesh_of({{0, 0, 0}, {cm, 0, 0}, {0, cm, 0}}, {{0, 1, 2}});
  const TriangleMesh twice = mesh_of({{0, 0, 0}, {cm, 0, 0}, {0, cm, 0}}, {{0, 1, 2}, {0, 2, 1}});
  const TriangleMesh line = mesh_of({{0, 0, 0}, {cm, 0, 0}, {2 * cm, 0, 0}}, {{0, 1, 2}});
  const TriangleMesh strip = mesh_of({{0, 0, 0}, {cm, 0, 0}, {0, cm, 0}, {cm, cm, 0}}, {{0, 1, 2}, {1, 3, 2}});
  for (const TriangleMesh& mesh : {one, twice, line, strip}) EXPECT_THROW(fix_surface(mesh, "nothing"), InputError);
}

TEST(SurfaceRepair, flat_pieces_beside_a_solid_are_dropped_with_a_word) {
  const TriangleMesh ball = sphere(Vec3::Zero(), 2 * cm, 2);
  const TriangleMesh sheet =
      mesh_of({{5 * cm, 0, 0}, {8 * cm, 0, 0}, {5 * cm, 3 * cm, 0}, {8 * cm, 3 * cm, 0}}, {{0, 1, 2}, {1, 3, 2}});
  const FixedSurface fixed = fix_surface(merged({ball, sheet}), "ball");
  EXPECT_NEAR(volume(fixed.mesh), volume(ball), 1e-12);
  EXPECT_THAT(fixed.repairs, testing::Contains(testing::HasSubstr("dropped 1 piece")));
}

/// The part of a ball's surface above a height, open below.
TriangleMesh cap_of_ball(const Vec3& center, Real radius, Real height) {
  TriangleMesh cap = sphere(center, radius, 4);
  Index kept = 0;
  for (Index f = 0; f < cap.face_count(); ++f)
    if (cap.vertices(2, cap.faces.col(f)[0]) - center.z() > height)
      cap.faces.col(kept++) = Eigen::Vector3i(cap.faces.col(f));
  cap.faces.conservativeResize(3, kept);
  return cap;
}

TEST(SurfaceRepair, an_open_sheet_beside_a_solid_is_dropped_and_a_solid_with_a_large_hole_is_closed) {
  const TriangleMesh ball = sphere(Vec3::Zero(), 2 * cm, 3);
  const FixedSurface beside_sheet = fix_surface(merged({ball, cap_of_ball(Vec3(8, 0, 0) * cm, 4 * cm, 3.2 * cm)}), "a");
  EXPECT_NEAR(volume(beside_sheet.mesh), volume(ball), 1e-12);
  EXPECT_THAT(beside_sheet.repairs, testing::Contains(testing::HasSubstr("dropped 1 open sheet")));
  const FixedSurface beside_half = fix_surface(merged({ball, cap_of_ball(Vec3(8, 0, 0) * cm, 1.5 * cm, 0)}), "b");
  EXPECT_EQ(pieces_of(beside_half.mesh).size(), 2u);
  // Alone a sheet is all there is.
  EXPECT_GT(volume(fix_surface(cap_of_ball(Vec3::Zero(), 4 * cm, 3.2 * cm), "c").mesh), 0);
}

TEST(SurfaceRepair, random_triangles_give_a_solid_or_a_refusal) {
  std::uint32_t state = 1;
  const auto next = [&](Index below) {
    return static_cast<Index>((state = state * 1664525 + 1013904223) >> 8) % below;
  };
  const TriangleMesh ball = sphere(Vec3::Zero(), 2 * cm, 2);
  for (int attempt = 0; attempt < 6; ++attempt) {
    TriangleMesh soup{ball.vertices, Eigen::Matrix3Xi(3, 1 + attempt * 6)};
    for (Index& v : soup.faces.reshaped()) v = next(ball.vertex_count());
    try {
      expect_solid(fix_surface(soup, "soup").mesh);
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("soup"));
    }
  }
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
