#include <gracilis/geometry/mesh_pieces.hpp>

#include <gracilis/geometry/measures.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

namespace gracilis {
namespace {

/// Their triangles as places, whatever their vertices are called.
Points corners_of(const TriangleMesh& mesh) {
  Points corners(3, 3 * mesh.face_count());
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (Index k = 0; k < 3; ++k) corners.col(3 * f + k) = mesh.vertices.col(mesh.faces(k, f));
  return corners;
}

void expect_same(const TriangleMesh& found, const TriangleMesh& expected) {
  EXPECT_EQ(found.vertex_count(), expected.vertex_count());
  EXPECT_EQ(corners_of(found), corners_of(expected));
}

const TriangleMesh small = shapes::box({0, 0, 0}, {1, 1, 1});
const TriangleMesh large = shapes::box({2, 0, 0}, {5, 3, 3});
/// More area than the large one, less inside.
const TriangleMesh sheet = shapes::box({6, 0, 0}, {15, 9, 0.1});

}  // namespace

TEST(MeshPieces, are_the_surfaces_that_were_put_into_one_the_largest_area_first) {
  const std::vector<TriangleMesh> pieces = pieces_of(merged({small, sheet, large}));
  ASSERT_EQ(pieces.size(), 3u);
  expect_same(pieces[0], sheet);
  expect_same(pieces[1], large);
  expect_same(pieces[2], small);
}

TEST(MeshPieces, vertices_that_no_face_names_are_left_out) {
  TriangleMesh mesh = merged({small, large});
  Points more(3, mesh.vertex_count() + 2);
  more << Vec3(9, 9, 9), mesh.vertices, Vec3(8, 8, 8);
  mesh.vertices = more;
  mesh.faces.array() += 1;
  const std::vector<TriangleMesh> pieces = pieces_of(mesh);
  ASSERT_EQ(pieces.size(), 2u);
  expect_same(pieces[0], large);
  expect_same(pieces[1], small);
}

TEST(MeshPieces, the_largest_is_the_one_that_encloses_most_whichever_way_it_is_turned) {
  TriangleMesh turned = large;
  turned.faces.row(0).swap(turned.faces.row(1));
  expect_same(largest_piece(merged({small, turned, sheet})), turned);
  expect_same(largest_piece(merged({sheet, large})), large);
  expect_same(largest_piece(small), small);
}

TEST(MeshPieces, nothing_merged_is_nothing) {
  EXPECT_EQ(merged({}).vertex_count(), 0);
  EXPECT_EQ(merged({TriangleMesh(), small}).face_count(), small.face_count());
}

}  // namespace gracilis
