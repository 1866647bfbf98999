#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/needles.hpp>
#include <gracilis/geometry/topology.hpp>
#include <gracilis/io/mesh/load_surface.hpp>
#include <gracilis/prepare/cgal.hpp>
#include <gracilis/prepare/mending.hpp>
#include <gracilis/prepare/solids.hpp>

#include "../io/test_files.hpp"
#include "shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

/// Surfaces mended so that a run takes them, and no more.
namespace gracilis {
namespace {

using shapes::both;
using shapes::sphere;

constexpr Real edge = 0.01;  // m

Real shortest_edge(const TriangleMesh& mesh) {
  Real least = 1;
  for (const MeshEdge& each : build_topology(mesh.faces, mesh.vertex_count()).edges)
    least = std::min(least, (mesh.vertices.col(each.a) - mesh.vertices.col(each.b)).norm());
  return least;
}

TEST(Mending, of_a_shell_in_a_shell_the_outer_one_is_left_bit_for_bit) {
  const TriangleMesh outer = sphere(Vec3::Zero(), 2 * edge, 3), inner = sphere(Vec3::Zero(), 1.5 * edge, 3);
  const FixedSurface mended = mended_surface(both(inner, outer), "balls");
  EXPECT_EQ(mended.mesh.vertices, outer.vertices);
  EXPECT_EQ(mended.mesh.faces, outer.faces);
  EXPECT_THAT(mended.repairs, testing::ElementsAre("dropped 1 shell that lies in another"));
}

TEST(Mending, where_nothing_is_wrong_triangles_stay) {
  const TriangleMesh left = sphere(Vec3::Zero(), 2 * edge, 3), right = sphere(Vec3(3 * edge, 0, 0), 2 * edge, 3);
  const FixedSurface mended = mended_surface(both(left, right), "balls");
  EXPECT_TRUE(is_solid(mended.mesh));
  EXPECT_LT(mended.mesh.face_count(), left.face_count() + right.face_count());
  Index away = 0;
  for (Index v = 0; v < left.vertex_count(); ++v) {
    if (left.vertices(0, v) > edge) continue;
    ++away;
    EXPECT_EQ((mended.mesh.vertices.colwise() - left.vertices.col(v)).colwise().norm().minCoeff(), 0);
  }
  EXPECT_GT(away, left.vertex_count() / 2);
}

TEST(Mending, where_pieces_were_united_no_edge_is_far_shorter_than_the_others) {
  // So many edges cross that some of the cut's are short by chance.
  const TriangleMesh left = sphere(Vec3::Zero(), 2 * edge, 4), right = sphere(Vec3(3 * edge, 1e-3, 2e-3), 2 * edge, 4);
  const TriangleMesh united = *exact_union(left, right), mended = mended_surface(both(left, right), "balls").mesh;
  EXPECT_LT(shortest_edge(united), 0.01 * even_edge(united));
  EXPECT_GT(shortest_edge(mended), 0.1 * even_edge(mended));
  EXPECT_FALSE(cuts_itself(mended, TimeLimit()));
  EXPECT_NEAR(volume_of(mended), volume_of(united), 1e-3 * volume_of(united));
}

/// A spindle along z (m), thick in the middle.
TriangleMesh spindle(Real x, Real bottom, Real top, Real radius) {
  TriangleMesh mesh = sphere(Vec3::Zero(), 1, 3);
  mesh.vertices.topRows(2) *= radius;
  mesh.vertices.row(2) *= (top - bottom) / 2;
  mesh.vertices.colwise() += Vec3(x, 0, (top + bottom) / 2);
  return mesh;
}

TEST(Mending, heads_that_cut_each_other_are_told_apart_from_pieces_of_a_muscle) {
  const TriangleMesh long_head = spindle(0, 0, 20 * edge, 2 * edge),
                     short_head = spindle(3 * edge, 0, 12 * edge, 1.5 * edge),
                     lower_half = spindle(0, -10 * edge, 1 * edge, 2 * edge),
                     woven = spindle(0.5 * edge, 1 * edge, 18 * edge, 1.9 * edge);
  const FixedSurface heads = mended_surface(both(long_head, short_head), "heads");
  EXPECT_EQ(heads.heads.size(), 2u);
  EXPECT_EQ(pieces_of(heads.mesh).size(), 1u);
  for (const TriangleMesh& other : {lower_half, woven}) {
    const FixedSurface whole = mended_surface(both(long_head, other), "whole");
    EXPECT_EQ(pieces_of(whole.mesh).size(), 1u);
    EXPECT_TRUE(whole.heads.empty());
  }
}

TEST(Mending, takes_no_longer_than_it_may) {
  const TriangleMesh ball = sphere(Vec3::Zero(), 2 * edge, 5), other = sphere(Vec3(1 * edge, 0, 0), 2 * edge, 5);
  EXPECT_THROW(mended_surface(both(ball, other), "balls", {.time_limit = 1e-3}), InputError);
}

TEST(Mending, the_scanned_muscles_become_such_as_a_run_takes) {
  GRACILIS_NEEDS_DATA("leg/as_scanned/piriformis_r.ply");
  int count = 0;
  for (const auto& file : std::filesystem::directory_iterator(data_root() / "leg" / "as_scanned")) {
    SCOPED_TRACE(file.path());
    const TriangleMesh mended = mended_surface(read_mesh(file.path(), 1), "muscle").mesh;
    EXPECT_NO_THROW(check_surface(mended, 1, SurfaceRole::muscle, "muscle"));
    EXPECT_FALSE(cuts_itself(mended, TimeLimit()));
    ++count;
  }
  EXPECT_EQ(count, 8);
}

}  // namespace
}  // namespace gracilis
