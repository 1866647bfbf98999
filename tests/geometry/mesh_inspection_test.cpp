#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/geometry/mesh_repair.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <ctime>
#include <limits>
#include <vector>

using namespace gracilis;

namespace {

TriangleMesh tetrahedron() {
  TriangleMesh mesh;
  mesh.vertices.resize(3, 4);
  mesh.vertices << 0, 1, 0, 0,  //
      0, 0, 1, 0,               //
      0, 0, 0, 1;
  mesh.faces.resize(3, 4);
  mesh.faces << 0, 0, 1, 2,  //
      2, 1, 2, 0,            //
      1, 3, 3, 3;
  return mesh;
}

/// n × n quads on a torus: closed, manifold, genus 1.
TriangleMesh torus(Index n) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, n * n);
  mesh.faces.resize(3, 2 * n * n);
  Index f = 0;
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      const Real u = 2 * pi * i / n, v = 2 * pi * j / n;
      mesh.vertices.col(i * n + j) << (2 + std::cos(v)) * std::cos(u), (2 + std::cos(v)) * std::sin(u), std::sin(v);
      const Index a = i * n + j, b = (i + 1) % n * n + j, c = (i + 1) % n * n + (j + 1) % n, d = i * n + (j + 1) % n;
      mesh.faces.col(f++) << a, b, c;
      mesh.faces.col(f++) << a, c, d;
    }
  }
  return mesh;
}

/// Both surfaces in one, the second moved by `offset`.
TriangleMesh together(const TriangleMesh& first, TriangleMesh second, const Vec3& offset) {
  TriangleMesh both;
  both.vertices.resize(3, first.vertices.cols() + second.vertices.cols());
  second.vertices.colwise() += offset;
  both.vertices << first.vertices, second.vertices;
  both.faces.resize(3, first.faces.cols() + second.faces.cols());
  both.faces << first.faces, (second.faces.array() + first.vertex_count()).matrix();
  return both;
}

/// Every face with vertices of its own, as an .stl holds it.
TriangleMesh soup_of(const TriangleMesh& mesh) {
  TriangleMesh soup;
  soup.vertices.resize(3, mesh.faces.size());
  soup.faces.resize(3, mesh.faces.cols());
  for (Index i = 0; i < mesh.faces.size(); ++i) {
    soup.vertices.col(i) = mesh.vertices.col(mesh.faces(i % 3, i / 3));
    soup.faces(i % 3, i / 3) = i;
  }
  return soup;
}

void expect_identical(const TriangleMesh& a, const TriangleMesh& b) {
  ASSERT_EQ(a.vertices.cols(), b.vertices.cols());
  ASSERT_EQ(a.faces.cols(), b.faces.cols());
  EXPECT_TRUE((a.vertices.array() == b.vertices.array()).all());
  EXPECT_TRUE((a.faces.array() == b.faces.array()).all());
}

void expect_sound(const MeshReport& report) {
  EXPECT_TRUE(report.is_closed());
  EXPECT_TRUE(report.is_manifold());
  EXPECT_TRUE(report.is_oriented());
  EXPECT_GT(report.volume, 0);
  EXPECT_FALSE(report.degenerate_faces);
  EXPECT_FALSE(report.unreferenced_vertices);
}

}  // namespace

TEST(MeshInspection, a_tetrahedron_is_sound_and_measured) {
  const MeshReport report = inspect_mesh(tetrahedron());
  expect_sound(report);
  EXPECT_FALSE(report.duplicate_vertices);
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.genus, 0);
  EXPECT_NEAR(report.volume, 1.0 / 6, 1e-15);
  EXPECT_NEAR(report.area, 1.5 + std::sqrt(3) / 2, 1e-15);
  EXPECT_EQ(report.high, Vec3(1, 1, 1));
}

TEST(MeshInspection, a_torus_has_genus_one) {
  const MeshReport report = inspect_mesh(torus(12));
  expect_sound(report);
  EXPECT_EQ(report.genus, 1);
}

TEST(MeshInspection, an_open_edge_is_reported_with_its_face) {
  TriangleMesh mesh = tetrahedron();
  mesh.faces.conservativeResize(3, 3);
  const MeshReport report = inspect_mesh(mesh);
  EXPECT_EQ(report.open_edges.count, 3);
  EXPECT_EQ(report.open_edges.first, 0);
  EXPECT_FALSE(report.is_closed());
  EXPECT_EQ(report.genus, -1);
}

TEST(MeshInspection, an_edge_with_three_faces_is_not_manifold) {
  TriangleMesh mesh = tetrahedron();
  mesh.vertices.conservativeResize(3, 5);
  mesh.vertices.col(4) << 2, 2, 2;
  mesh.faces.conservativeResize(3, 5);
  mesh.faces.col(4) << 0, 1, 4;
  const MeshReport report = inspect_mesh(mesh);
  EXPECT_EQ(report.non_manifold_edges.count, 1);
  EXPECT_EQ(report.open_edges.count, 2);
  EXPECT_FALSE(report.is_manifold());
}

TEST(MeshInspection, two_parts_touching_in_a_vertex_are_a_pinch) {
  TriangleMesh mesh = together(tetrahedron(), tetrahedron(), Vec3(1, 0, 0));
  for (Index& v : mesh.faces.reshaped()) v = v == 4 ? 1 : v;
  const MeshReport report = inspect_mesh(mesh);
  EXPECT_EQ(report.pinched_vertices.count, 1);
  EXPECT_EQ(report.pinched_vertices.first, 1);
  EXPECT_FALSE(report.open_edges);
  EXPECT_FALSE(report.non_manifold_edges);
  EXPECT_EQ(report.components, 1);
  EXPECT_FALSE(report.is_manifold());
}

TEST(MeshInspection, a_turned_face_disagrees_along_its_three_edges) {
  TriangleMesh mesh = tetrahedron();
  std::swap(mesh.faces(0, 2), mesh.faces(1, 2));
  const MeshReport report = inspect_mesh(mesh);
  EXPECT_EQ(report.inconsistent_edges.count, 3);
  EXPECT_FALSE(report.is_oriented());
}

TEST(MeshInspection, indices_and_coordinates_out_of_bounds_are_found_before_anything_else) {
  TriangleMesh mesh = tetrahedron();
  mesh.faces(1, 2) = 4;
  EXPECT_EQ(inspect_mesh(mesh).out_of_range_faces.first, 2);
  mesh.faces(1, 2) = -1;
  EXPECT_EQ(inspect_mesh(mesh).out_of_range_faces.first, 2);
  mesh = tetrahedron();
  mesh.vertices(1, 3) = std::numeric_limits<Real>::quiet_NaN();
  EXPECT_EQ(inspect_mesh(mesh).non_finite_vertices.first, 3);
  mesh.vertices(1, 3) = std::numeric_limits<Real>::infinity();
  EXPECT_EQ(inspect_mesh(mesh).non_finite_vertices.count, 1);
}

TEST(MeshInspection, nothing_at_all_is_neither_closed_nor_a_crash) {
  const MeshReport report = inspect_mesh({});
  EXPECT_EQ(report.face_count, 0);
  EXPECT_FALSE(report.is_closed());
}

TEST(MeshInspection, many_vertices_in_one_plane_take_no_longer_than_others) {
  // Of a grid's planes every pair was looked at: minutes instead of a tenth of a second.
  constexpr Index across = 400;
  for (Index axis = 0; axis < 3; ++axis) {
    Points flat = Points::Zero(3, across * across);
    for (Index v = 0; v < flat.cols(); ++v) {
      flat((axis + 1) % 3, v) = static_cast<Real>(v % across);
      flat((axis + 2) % 3, v) = static_cast<Real>(v / across);
    }
    flat.col(across) = flat.col(7);
    const std::clock_t start = std::clock();
    const std::vector<Index> first = first_at_same_place(flat);
    EXPECT_LT(Real(std::clock() - start) / CLOCKS_PER_SEC, 5);
    EXPECT_EQ(first[across], 7);
    EXPECT_EQ(first[across + 1], across + 1);
  }
}

TEST(MeshRepair, a_sound_surface_stays_the_same_bit_for_bit) {
  for (const TriangleMesh& mesh : {tetrahedron(), torus(9), together(torus(6), torus(6), Vec3(10, 0, 0))}) {
    const RepairedMesh repaired = repair_mesh(mesh);
    EXPECT_TRUE(repaired.repairs.empty());
    expect_identical(repaired.mesh, mesh);
  }
}

TEST(MeshRepair, a_sound_surface_that_touches_itself_stays_the_same) {
  const TriangleMesh mesh = together(tetrahedron(), tetrahedron(), Vec3(1, 0, 0));  // vertices 1 and 4 coincide
  ASSERT_EQ(inspect_mesh(mesh).duplicate_vertices.count, 1);
  const RepairedMesh repaired = repair_mesh(mesh);
  EXPECT_TRUE(repaired.repairs.empty());
  expect_identical(repaired.mesh, mesh);
}

TEST(MeshRepair, a_triangle_soup_becomes_one_closed_surface) {
  const RepairedMesh repaired = repair_mesh(soup_of(torus(8)));
  const MeshReport report = inspect_mesh(repaired.mesh);
  expect_sound(report);
  EXPECT_EQ(report.vertex_count, 64);
  EXPECT_EQ(report.genus, 1);
  EXPECT_FALSE(repaired.repairs.empty());
}

TEST(MeshRepair, a_soup_of_two_bodies_that_touch_along_an_edge_stays_one) {
  const TriangleMesh soup = soup_of(shapes::box(Vec3::Zero(), Vec3::Ones()));
  const TriangleMesh touching = together(soup, soup, Vec3(1, 1, 0)), apart = together(soup, soup, Vec3(1.5, 1, 0));
  EXPECT_TRUE(repair_mesh(touching).mesh.vertices == touching.vertices) << "four faces would meet in one edge";
  EXPECT_EQ(repair_mesh(apart).mesh.vertex_count(), 16);
}

TEST(MeshRepair, vertices_in_no_face_are_dropped_and_the_others_keep_their_order) {
  TriangleMesh mesh = tetrahedron();
  mesh.vertices.conservativeResize(3, 6);
  mesh.vertices.col(4) << 5, 5, 5;
  mesh.vertices.col(5) << 6, 6, 6;
  const RepairedMesh repaired = repair_mesh(mesh);
  expect_identical(repaired.mesh, tetrahedron());
  ASSERT_EQ(repaired.repairs.size(), 1u);
  EXPECT_EQ(repaired.repairs[0], "dropped 2 unreferenced vertices, first 4");
}

TEST(MeshRepair, turned_faces_are_turned_back) {
  TriangleMesh mesh = torus(8);
  for (const Index f : {3, 17, 18, 90}) std::swap(mesh.faces(1, f), mesh.faces(2, f));
  const RepairedMesh repaired = repair_mesh(mesh);
  expect_identical(repaired.mesh, torus(8));
  EXPECT_EQ(repaired.repairs.size(), 1u);
}

TEST(MeshRepair, an_inside_out_surface_is_turned_outwards) {
  TriangleMesh mesh = torus(8);
  mesh.faces.row(1).swap(mesh.faces.row(2));
  ASSERT_LT(inspect_mesh(mesh).volume, 0);
  expect_identical(repair_mesh(mesh).mesh, torus(8));
}

TEST(MeshRepair, a_piece_that_is_inside_out_is_turned_outwards_beside_a_larger_one) {
  TriangleMesh small = tetrahedron();
  small.vertices = (0.5 * small.vertices).eval();
  TriangleMesh turned = small;
  turned.faces.row(1).swap(turned.faces.row(2));
  for (const Vec3& place : {Vec3(5, 0, 0), Vec3(0, 0, 0)}) {  // beside the ring, and in its hole
    const RepairedMesh repaired = repair_mesh(together(torus(8), turned, place));
    expect_identical(repaired.mesh, together(torus(8), small, place));
    ASSERT_EQ(repaired.repairs.size(), 1u);
    EXPECT_EQ(repaired.repairs[0], "turned 1 piece that was inside out");
  }
}

TEST(MeshRepair, a_large_piece_that_is_inside_out_turns_no_small_one_beside_it) {
  TriangleMesh large = torus(8);
  large.faces.row(1).swap(large.faces.row(2));
  const Vec3 place(5, 0, 0);
  expect_identical(repair_mesh(together(large, tetrahedron(), place)).mesh, together(torus(8), tetrahedron(), place));
}

TEST(MeshRepair, a_flat_piece_whose_volume_is_rounding_is_not_turned) {
  TriangleMesh flat = tetrahedron();
  flat.vertices.col(3) << 1, 1, -1e-15;
  ASSERT_LT(inspect_mesh(flat).volume, 0);
  const TriangleMesh mesh = together(torus(8), flat, Vec3(5, 0, 0));
  const RepairedMesh repaired = repair_mesh(mesh);
  expect_identical(repaired.mesh, mesh);
  EXPECT_TRUE(repaired.repairs.empty());
}

TEST(MeshRepair, a_hollow_stays_one_and_turns_with_what_it_lies_in) {
  TriangleMesh hollow = tetrahedron();
  hollow.vertices = (0.2 * hollow.vertices).eval();
  hollow.faces.row(1).swap(hollow.faces.row(2));
  const TriangleMesh solid = together(tetrahedron(), hollow, Vec3(0.1, 0.1, 0.1));
  const RepairedMesh untouched = repair_mesh(solid);
  expect_identical(untouched.mesh, solid);
  EXPECT_TRUE(untouched.repairs.empty());
  TriangleMesh inside_out = solid;
  inside_out.faces.row(1).swap(inside_out.faces.row(2));
  const RepairedMesh turned = repair_mesh(inside_out);
  expect_identical(turned.mesh, solid);
  ASSERT_EQ(turned.repairs.size(), 1u);
  EXPECT_EQ(turned.repairs[0], "turned all faces outwards");
}

TEST(MeshRepair, a_face_that_names_a_vertex_twice_is_dropped) {
  TriangleMesh mesh = tetrahedron();
  mesh.faces.conservativeResize(3, 5);
  mesh.faces.col(4) << 1, 1, 2;
  expect_identical(repair_mesh(mesh).mesh, tetrahedron());
}

TEST(MeshRepair, an_edge_of_no_length_is_collapsed) {
  // Vertex 4 stands on vertex 3; two faces without area fill the slit between them.
  TriangleMesh mesh = tetrahedron();
  mesh.vertices.conservativeResize(3, 5);
  mesh.vertices.col(4) = mesh.vertices.col(3);
  mesh.faces.resize(3, 6);
  mesh.faces << 0, 0, 1, 2, 1, 0,  //
      2, 1, 2, 0, 4, 3,            //
      1, 3, 4, 4, 3, 4;
  ASSERT_TRUE(inspect_mesh(mesh).is_closed());
  ASSERT_EQ(inspect_mesh(mesh).degenerate_faces.count, 2);
  const RepairedMesh repaired = repair_mesh(mesh);
  expect_sound(inspect_mesh(repaired.mesh));
  EXPECT_EQ(repaired.mesh.vertex_count(), 4);
}

TEST(MeshRepair, a_face_that_is_a_line_gets_its_longest_edge_flipped) {
  // Vertex 4 lies on the edge 1-2 of the face (1, 2, 3), which is cut there; the face (2, 1, 4) fills the gap without
  // area.
  TriangleMesh mesh = tetrahedron();
  mesh.vertices.conservativeResize(3, 5);
  mesh.vertices.col(4) << 0.5, 0.5, 0;
  mesh.faces.resize(3, 6);
  mesh.faces << 0, 0, 1, 4, 1, 2,  //
      2, 1, 4, 2, 2, 0,            //
      1, 3, 3, 3, 4, 3;
  ASSERT_TRUE(inspect_mesh(mesh).is_closed());
  ASSERT_TRUE(inspect_mesh(mesh).is_oriented());
  ASSERT_EQ(inspect_mesh(mesh).degenerate_faces.count, 1);
  const RepairedMesh repaired = repair_mesh(mesh);
  expect_sound(inspect_mesh(repaired.mesh));
  EXPECT_EQ(repaired.mesh.face_count(), 6);
  EXPECT_NEAR(inspect_mesh(repaired.mesh).volume, 1.0 / 6, 1e-15);
}

TEST(MeshRepair, a_face_that_is_a_line_stays_where_flipping_it_would_double_an_edge) {
  TriangleMesh mesh;  // vertex 2 lies on the edge 0-1; a third face runs along 3-2 already
  mesh.vertices.resize(3, 5);
  mesh.vertices << 0, 2, 1, 1, 1, 0, 0, 0, 1, 0.5, 0, 0, 0, 0, 1;
  mesh.faces.resize(3, 3);
  mesh.faces << 0, 1, 3, 1, 0, 2, 2, 3, 4;
  EXPECT_TRUE(repair_mesh(mesh).mesh.faces == mesh.faces);
}

TEST(MeshRepair, crumbs_are_dropped_only_when_asked) {
  TriangleMesh crumb = tetrahedron();
  crumb.vertices *= 0.01;
  const TriangleMesh mesh = together(torus(8), crumb, Vec3(5, 0, 0));
  expect_identical(repair_mesh(mesh).mesh, mesh);
  expect_identical(repair_mesh(mesh, 0.01).mesh, torus(8));
}
