#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/geometry/needles.hpp>
#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/geometry/topology.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace gracilis {
namespace {

/// A closed cylinder about the z axis of strips from end to end, whose ends are fans: `sides` needles each way.
TriangleMesh needles(Real radius, Real length, Index sides) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, 2 * sides + 2);
  mesh.faces.resize(3, 4 * sides);
  for (Index i = 0; i < sides; ++i) {
    const Real angle = 2 * pi * i / sides;
    mesh.vertices.col(i) = Vec3(radius * std::cos(angle), radius * std::sin(angle), 0);
    mesh.vertices.col(sides + i) = mesh.vertices.col(i) + Vec3(0, 0, length);
    const Index next = (i + 1) % sides;
    mesh.faces.col(4 * i) << i, next, sides + i;
    mesh.faces.col(4 * i + 1) << next, sides + next, sides + i;
    mesh.faces.col(4 * i + 2) << 2 * sides, next, i;
    mesh.faces.col(4 * i + 3) << 2 * sides + 1, sides + i, sides + next;
  }
  mesh.vertices.col(2 * sides) = Vec3::Zero();
  mesh.vertices.col(2 * sides + 1) = Vec3(0, 0, length);
  return mesh;
}

/// A body that is curved both ways, of triangles that are eight times as long as wide.
TriangleMesh drawn_out_ball() {
  TriangleMesh ball = shapes::sphere(Vec3::Zero(), 0.02, 3);
  ball.vertices.row(2) *= 8;
  return ball;
}

Real longest_edge(const TriangleMesh& mesh) {
  Real longest = 0;
  for (const MeshEdge& edge : build_topology(mesh.faces, mesh.vertex_count()).edges)
    longest = std::max(longest, (mesh.vertices.col(edge.a) - mesh.vertices.col(edge.b)).norm());
  return longest;
}

/// Height over longest edge.
Real roundness(const TriangleMesh& mesh, Index face) {
  const Vec3 a = mesh.vertices.col(mesh.faces(0, face)), b = mesh.vertices.col(mesh.faces(1, face)),
             c = mesh.vertices.col(mesh.faces(2, face));
  const Real longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  return (b - a).cross(c - a).norm() / (longest * longest);
}

Real share_of_thin(const TriangleMesh& mesh) {
  Index thin = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) thin += roundness(mesh, f) < 0.2;
  return static_cast<Real>(thin) / mesh.face_count();
}

}  // namespace

TEST(Needles, even_edge_is_that_of_equal_triangles) {
  TriangleMesh tetrahedron;
  tetrahedron.vertices.resize(3, 4);
  tetrahedron.vertices << 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1, 1;
  tetrahedron.faces.resize(3, 4);
  tetrahedron.faces << 0, 0, 0, 1, 1, 2, 3, 3, 2, 3, 1, 2;
  EXPECT_NEAR(even_edge(tetrahedron), 2 * std::sqrt(2.0), 1e-12);
  EXPECT_EQ(even_edge({Points(3, 0), Eigen::Matrix3Xi(3, 0)}), 0);
}

TEST(Needles, are_in_thinned_surfaces_and_not_in_even_ones) {
  EXPECT_TRUE(has_needles(needles(0.01, 0.2, 40)));
  EXPECT_FALSE(has_needles(shapes::sphere(Vec3::Zero(), 0.02, 3)));
  EXPECT_FALSE(has_needles(shapes::cylinder(0.012, 0.2, 24, 40)));
  EXPECT_FALSE(has_needles({Points(3, 0), Eigen::Matrix3Xi(3, 0)}));
}

TEST(Needles, divided_leave_a_closed_surface_with_the_old_vertices_first) {
  const TriangleMesh before = needles(0.01, 0.2, 40);
  const DividedNeedles divided = divide_needles(before);
  const TriangleMesh& after = divided.mesh;
  EXPECT_EQ(after.vertices.leftCols(before.vertex_count()), before.vertices);
  ASSERT_EQ(after.vertex_count(), before.vertex_count() + static_cast<Index>(divided.ends.size()));
  for (std::size_t i = 0; i < divided.ends.size(); ++i) {
    const Index v = before.vertex_count() + static_cast<Index>(i);
    const auto [a, b] = divided.ends[i];
    ASSERT_LT(std::max(a, b), v);
    EXPECT_EQ(Vec3(after.vertices.col(v)), Vec3((after.vertices.col(a) + after.vertices.col(b)) / 2));
  }
  const MeshReport report = inspect_mesh(after);
  EXPECT_FALSE(report.open_edges || report.non_manifold_edges || report.inconsistent_edges || report.pinched_vertices ||
               report.degenerate_faces || report.unreferenced_vertices);
  EXPECT_EQ(report.components, 1);
}

TEST(Needles, divided_have_no_edge_longer_than_two_and_a_half_even_ones) {
  const TriangleMesh before = needles(0.01, 0.2, 40), after = divide_needles(before).mesh;
  EXPECT_LE(longest_edge(after), 2.5 * even_edge(before));
  EXPECT_FALSE(has_needles(after));
}

TEST(Needles, divided_leave_fewer_thin_triangles) {
  const TriangleMesh before = drawn_out_ball(), after = divide_needles(before).mesh;
  EXPECT_TRUE(has_needles(before));
  EXPECT_GT(share_of_thin(before), 0.4);
  EXPECT_LT(share_of_thin(after), 0.5 * share_of_thin(before));
}

TEST(Needles, divided_move_the_surface_by_less_than_a_tenth_of_an_edge) {
  const TriangleMesh before = drawn_out_ball(), after = divide_needles(before).mesh;
  const SignedDistance from_before(before);
  Real farthest = 0;
  for (Index f = 0; f < after.face_count(); ++f) {
    const Vec3 middle = after.vertices(Eigen::all, after.faces.col(f)).rowwise().mean();
    farthest = std::max(farthest, std::abs(from_before.query(middle).distance));
  }
  EXPECT_LT(farthest, 0.1 * even_edge(before));
  EXPECT_NEAR(enclosed_volume(after.vertices, after.faces) / enclosed_volume(before.vertices, before.faces), 1, 0.01);
}

TEST(Needles, of_an_even_surface_divided_are_none) {
  const TriangleMesh ball = shapes::sphere(Vec3::Zero(), 0.02, 3);
  const DividedNeedles divided = divide_needles(ball);
  EXPECT_TRUE(divided.ends.empty());
  EXPECT_EQ(divided.mesh.vertices, ball.vertices);
}

TEST(Needles, of_a_surface_without_area_are_left) {
  TriangleMesh flat = shapes::sphere(Vec3::Zero(), 0.02, 1);
  flat.vertices.setZero();
  EXPECT_EQ(divide_needles(flat).mesh.faces, flat.faces);
  EXPECT_FALSE(has_needles(flat));
}

}  // namespace gracilis
