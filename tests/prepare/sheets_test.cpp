#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/prepare/solids.hpp>
#include <gracilis/prepare/surface_repair.hpp>

#include "shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

/// Surfaces that touch themselves, and those whose triangles do not hang together.
namespace gracilis {
namespace {

using shapes::mesh_of;
using shapes::sphere;

constexpr Real centimetre = 0.01;  ///< m

/// The surface of cubes of a centimetre, whose lowest corners these are.
TriangleMesh cubes(const std::vector<std::array<int, 2>>& cells) {
  std::map<std::array<int, 3>, int> number;
  std::vector<Vec3> vertices;
  const auto vertex = [&](int x, int y, int z) {
    const auto [found, fresh] = number.try_emplace({x, y, z}, static_cast<int>(vertices.size()));
    if (fresh) vertices.emplace_back(Vec3(x, y, z) * centimetre);
    return found->second;
  };
  std::vector<Eigen::Vector3i> faces;
  const auto square = [&](int a, int b, int c, int d) { faces.insert(faces.end(), {{a, b, c}, {a, c, d}}); };
  const auto filled = [&](int x, int y) {
    return std::find(cells.begin(), cells.end(), std::array<int, 2>{x, y}) != cells.end();
  };
  for (const auto& [x, y] : cells) {
    const auto at = [&, x = x, y = y](int i, int j, int k) { return vertex(x + i, y + j, k); };
    square(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));
    square(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
    if (!filled(x - 1, y)) square(at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0));
    if (!filled(x + 1, y)) square(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));
    if (!filled(x, y - 1)) square(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
    if (!filled(x, y + 1)) square(at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0));
  }
  return mesh_of(vertices, faces);
}

/// A hook of seven cubes whose ends touch along an edge: four faces there.
TriangleMesh hook() { return cubes({{0, 0}, {0, -1}, {1, -1}, {2, -1}, {2, 0}, {2, 1}, {1, 1}}); }

/// Every triangle with vertices of its own, each moved by up to `crack`.
TriangleMesh loose_triangles(const TriangleMesh& mesh, Real crack) {
  TriangleMesh loose{Points(3, 3 * mesh.face_count()), Eigen::Matrix3Xi(3, mesh.face_count())};
  for (Index i = 0; i < 3 * mesh.face_count(); ++i) {
    loose.vertices.col(i) = mesh.vertices.col(mesh.faces(i % 3, i / 3)) +
                            crack * Vec3(std::sin(7.0 * i), std::sin(11.0 * i), std::sin(13.0 * i));
    loose.faces(i % 3, i / 3) = i;
  }
  return loose;
}

void expect_sound(const FixedSurface& fixed, std::size_t pieces, Real volume, Real tolerance) {
  EXPECT_TRUE(is_solid(fixed.mesh));
  EXPECT_FALSE(cuts_itself(fixed.mesh, TimeLimit()));
  EXPECT_EQ(pieces_of(fixed.mesh).size(), pieces);
  EXPECT_NEAR(volume_of(fixed.mesh) / volume, 1, tolerance);
}

TEST(Sheets, a_surface_that_touches_itself_along_an_edge_stays_closed_with_its_own_triangles) {
  const TriangleMesh touching = hook();
  ASSERT_TRUE(inspect_mesh(touching).non_manifold_edges);
  const FixedSurface fixed = fix_surface(touching, "hook");
  expect_sound(fixed, 1, 7 * centimetre * centimetre * centimetre, 0.02);  // two edges move by a twentieth of a cube's
  EXPECT_EQ(fixed.mesh.face_count(), touching.face_count());
}

TEST(Sheets, loose_triangles_of_a_surface_that_touches_itself_grow_together) {
  expect_sound(fix_surface(loose_triangles(hook(), 0), "hook"), 1, 7 * centimetre * centimetre * centimetre, 0.02);
}

TEST(Sheets, a_wall_across_a_solid_goes) {
  // Two cubes, and the square between them.
  TriangleMesh walled = cubes({{0, 0}, {1, 0}});
  std::vector<int> corners;
  for (Index v = 0; v < walled.vertex_count(); ++v)
    if (std::abs(walled.vertices(0, v) - centimetre) < 1e-9) corners.push_back(v);
  ASSERT_EQ(corners.size(), 4u);
  std::sort(corners.begin(), corners.end(), [&](int l, int r) {
    const auto angle = [&](int v) {
      return std::atan2(walled.vertices(2, v) - centimetre / 2, walled.vertices(1, v) - centimetre / 2);
    };
    return angle(l) < angle(r);
  });
  walled.faces.conservativeResize(3, walled.face_count() + 2);
  walled.faces.rightCols(2) << corners[0], corners[0], corners[1], corners[2], corners[2], corners[3];
  ASSERT_TRUE(inspect_mesh(walled).non_manifold_edges);
  const FixedSurface fixed = fix_surface(walled, "walled");
  EXPECT_TRUE(is_solid(fixed.mesh));
  EXPECT_NEAR(volume_of(fixed.mesh) / (2 * centimetre * centimetre * centimetre), 1, 0.05);
}

TEST(Sheets, cracks_between_triangles_close) {
  const TriangleMesh ball = sphere(Vec3::Zero(), 2 * centimetre, 3);
  const FixedSurface fixed = fix_surface(loose_triangles(ball, 0.00005), "cracked");  // edges are 2 to 3 mm
  expect_sound(fixed, 1, volume_of(ball), 0.01);
  EXPECT_EQ(fixed.mesh.face_count(), ball.face_count());
  EXPECT_THAT(fixed.repairs, testing::Contains(testing::HasSubstr("closed cracks")));
}

TEST(Sheets, holes_are_no_cracks) {
  TriangleMesh open = sphere(Vec3::Zero(), 2 * centimetre, 3);
  open.faces.conservativeResize(3, open.face_count() - 12);
  EXPECT_THAT(fix_surface(open, "open").repairs,
              testing::AllOf(testing::Contains(testing::HasSubstr("filled 1 hole")),
                             testing::Not(testing::Contains(testing::HasSubstr("cracks")))));
}

}  // namespace
}  // namespace gracilis
