#include <gracilis/geometry/box_mesh.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/geometry/topology.hpp>

#include <gtest/gtest.h>

namespace gracilis {

TEST(BoxMesh, is_closed_outward_and_has_the_volume_and_triangles_of_its_grid) {
  const TriangleMesh mesh = box_mesh(Vec3(-1, 0, 2), Vec3(1, 3, 6), {2, 3, 4});
  EXPECT_EQ(mesh.face_count(), 4 * (6 + 12 + 8));
  EXPECT_EQ(mesh.vertex_count(), mesh.face_count() / 2 + 2) << "Euler";
  EXPECT_TRUE(is_closed(mesh.faces));
  EXPECT_NEAR(enclosed_volume(mesh.vertices, mesh.faces), 24, 1e-12);
  for (Index f = 0; f < mesh.face_count(); ++f)
    EXPECT_NEAR(area_vector(mesh.vertices, mesh.faces.col(f)).norm(), 1, 1e-12) << "cells of 1 x 1";
}

TEST(BoxMesh, of_twenty_one_cells_a_side_has_5292_triangles) {
  const TriangleMesh mesh = box_mesh(Vec3::Zero(), Vec3::Constant(0.1), {21, 21, 21});
  EXPECT_EQ(mesh.face_count(), 5292);
  const MeshReport report = inspect_mesh(mesh);
  EXPECT_EQ(report.components, 1);
  EXPECT_FALSE(report.open_edges);
  EXPECT_FALSE(report.degenerate_faces);
}

TEST(BoxMesh, of_single_cells_is_the_plain_box) {
  const TriangleMesh mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), {1, 1, 1});
  EXPECT_EQ(mesh.face_count(), 12);
  EXPECT_EQ(mesh.vertex_count(), 8);
  EXPECT_NEAR(enclosed_volume(mesh.vertices, mesh.faces), 1, 1e-15);
}

}  // namespace gracilis
