#include <gracilis/anatomy/sections/cylinder_surface.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/section_frames.hpp>
#include <gracilis/geometry/signed_distance.hpp>
#include <gracilis/opensim/import/drawn_apart.hpp>

#include <gtest/gtest.h>

namespace gracilis::opensim {

/// 0.2 m along z at x, of 11 sections of 12 corners.
static SectionedSurface tube(Real x, Real radius) {
  SectionedSurface tube;
  tube.centers = Points::Zero(3, 11);
  for (Eigen::Index k = 0; k < 11; ++k) tube.centers.col(k) = Vec3(x, 0, 0.02 * static_cast<Real>(k) - 0.1);
  const Eigen::MatrixXd radii = Eigen::MatrixXd::Constant(12, 11, radius);
  tube.surface.vertices = section_vertices(tube.centers, section_frames(tube.centers, Vec3::UnitX()), radii);
  tube.surface.faces = section_faces(11, 12);
  return tube;
}

/// How deep a vertex of one, other than of its first and last section, lies in the other, m.
static Real deepest(const TriangleMesh& one, const TriangleMesh& other) {
  const SignedDistance distance(other);
  Real deepest = 0;
  for (Index v = 12; v < 120; ++v) deepest = std::max(deepest, -distance.query(one.vertices.col(v)).distance);
  return deepest;
}

static Real share_left(const SectionedSurface& now, const SectionedSurface& before) {
  return enclosed_volume(now.surface.vertices, now.surface.faces) /
         enclosed_volume(before.surface.vertices, before.surface.faces);
}

TEST(DrawnApart, surfaces_that_overlap_come_apart_and_their_ends_stay) {
  const std::vector<SectionedSurface> given = {tube(0, 0.02), tube(0.035, 0.02)};
  std::vector<SectionedSurface> muscles = given;
  EXPECT_GT(deepest(given[0].surface, given[1].surface), 0.004);
  draw_apart(muscles);
  for (std::size_t m = 0; m < 2; ++m) {
    EXPECT_LT(deepest(muscles[m].surface, muscles[1 - m].surface), 1e-4) << m;
    EXPECT_EQ(muscles[m].surface.vertices.leftCols(12), given[m].surface.vertices.leftCols(12));
    EXPECT_EQ(muscles[m].surface.vertices.rightCols(14), given[m].surface.vertices.rightCols(14));
  }
  EXPECT_NEAR(share_left(muscles[0], given[0]), share_left(muscles[1], given[1]), 0.02);
  EXPECT_GT(share_left(muscles[0], given[0]), 0.8);
}

TEST(DrawnApart, a_tendon_keeps_more_of_its_shape_than_the_belly_that_makes_way) {
  const std::vector<SectionedSurface> given = {tube(0, 0.02), tube(0.019, 0.003)};
  std::vector<SectionedSurface> muscles = given;
  draw_apart(muscles);
  EXPECT_LT(deepest(muscles[1].surface, muscles[0].surface), 1e-4);
  Real belly = 0, tendon = 0;  // m, of the farthest corner's way
  for (Index v = 12; v < 120; ++v) {
    belly = std::max(belly, (muscles[0].surface.vertices.col(v) - given[0].surface.vertices.col(v)).norm());
    tendon = std::max(tendon, (muscles[1].surface.vertices.col(v) - given[1].surface.vertices.col(v)).norm());
  }
  EXPECT_GT(belly, 2 * tendon);
}

TEST(DrawnApart, surfaces_that_do_not_touch_stay_bit_by_bit) {
  const std::vector<SectionedSurface> given = {tube(0, 0.02), tube(0.1, 0.02)};
  std::vector<SectionedSurface> muscles = given;
  draw_apart(muscles);
  for (std::size_t m = 0; m < 2; ++m)
    EXPECT_TRUE(muscles[m].surface.vertices.isApprox(given[m].surface.vertices, 1e-15));
}

}  // namespace gracilis::opensim
