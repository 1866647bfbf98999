#include <gracilis/anatomy/sections/cylinder_surface.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/geometry/section_frames.hpp>
#include <gracilis/opensim/import/bone_clearance.hpp>

#include <shapes.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace gracilis::opensim {

static Points straight(const Vec3& from, const Vec3& to, Eigen::Index count) {
  Points line(3, count);
  for (Eigen::Index k = 0; k < count; ++k)
    line.col(k) = from + static_cast<Real>(k) / static_cast<Real>(count - 1) * (to - from);
  return line;
}

static std::vector<SolidBone> shaft() {
  std::vector<SolidBone> bones;
  bones.emplace_back(shapes::box({-0.02, -0.02, -0.2}, {0.02, 0.02, 0.2}));
  return bones;
}

static Points corners(const ClearSections& clear) {
  return section_vertices(clear.centers, section_frames(clear.centers, Vec3::UnitX()), clear.radii);
}

TEST(BoneClearance, sections_far_from_bones_stay_as_they_are) {
  const Points line = straight({0.1, 0, -0.15}, {0.1, 0, 0.15}, 21);
  const Eigen::VectorXd radii = Eigen::VectorXd::Constant(21, 0.02);
  const ClearSections clear = clear_of_bones(line, radii, 12, shaft());
  EXPECT_EQ(clear.centers, line);
  EXPECT_LT((clear.radii.array() - 0.02).abs().maxCoeff(), 1e-12);
}

TEST(BoneClearance, a_line_through_a_bone_is_brought_out_and_its_sections_lie_against_it) {
  // Between two ends outside of the bone, 8 mm deep.
  Points line = straight({0.012, 0.003, -0.15}, {0.012, 0.003, 0.15}, 21);
  line(0, 0) = line(0, 20) = 0.025;
  Eigen::VectorXd radii(21);
  for (Eigen::Index k = 0; k < 21; ++k) radii[k] = 0.003 + 0.012 * std::sin(pi * static_cast<Real>(k) / 20);
  const std::vector<SolidBone> bones = shaft();
  const ClearSections clear = clear_of_bones(line, radii, 12, bones);
  EXPECT_EQ(clear.centers.col(0), line.col(0));
  EXPECT_EQ(clear.centers.col(20), line.col(20));
  const Points vertices = corners(clear);
  for (Eigen::Index v = 12; v < 20 * 12; ++v) EXPECT_GT(bones[0].distance.query(vertices.col(v)).distance, 0.0002) << v;
  // Sections keep their areas, and go the short way out: to the side of x.
  for (Eigen::Index k = 1; k < 20; ++k) {
    Real area = 0;
    for (Eigen::Index i = 0; i < 12; ++i) area += clear.radii(i, k) * clear.radii((i + 1) % 12, k);
    EXPECT_NEAR(area / (12 * radii[k] * radii[k]), 1, 0.02) << k;
    EXPECT_GT(clear.centers(0, k), 0.02);
  }
  // Softly: no part of the line turns by more than 40 degrees.
  for (Eigen::Index k = 1; k < 20; ++k) {
    const Vec3 before = clear.centers.col(k) - clear.centers.col(k - 1),
               after = clear.centers.col(k + 1) - clear.centers.col(k);
    EXPECT_GT(before.normalized().dot(after.normalized()), std::cos(radians(40))) << k;
  }
}

/// How deep an edge between two corners comes at most in a bone, m.
static Real deepest(const SolidBone& bone, const Vec3& from, const Vec3& to) {
  Real depth = 0;
  for (int i = 0; i <= 50; ++i) depth = std::max(depth, -bone.distance.query(from + (to - from) * i / 50).distance);
  return depth;
}

TEST(BoneClearance, edges_between_corners_are_brought_out_of_a_ridge) {
  // The ridge lies between two sections, 6 mm deep in the edges between their corners and in no corner.
  const Points line = straight({0, 0, -0.15}, {0, 0, 0.15}, 31);
  const Eigen::VectorXd radii = Eigen::VectorXd::Constant(31, 0.02);
  std::vector<SolidBone> bones;
  bones.emplace_back(shapes::box({0.014, -0.03, 0.003}, {0.04, 0.03, 0.007}));
  const ClearSections clear = clear_of_bones(line, radii, 12, bones);
  const Points vertices = corners(clear);
  const Points round = section_vertices(line, section_frames(line, Vec3::UnitX()), radii.transpose().replicate(12, 1));
  Real before = 0;
  for (Eigen::Index v = 0; v < 30 * 12; ++v) {
    before = std::max(before, deepest(bones[0], round.col(v), round.col(v + 12)));
    EXPECT_LT(deepest(bones[0], vertices.col(v), vertices.col(v + 12)), 0.0003) << v;
  }
  EXPECT_GT(before, 0.0015);
  EXPECT_NEAR(clear.volume_share, 1, 0.02);
}

TEST(BoneClearance, a_line_that_ends_in_a_bone_ends_on_its_surface) {
  const Points line = straight({0.1, 0, 0}, {0.014, 0.003, 0}, 11);
  const Eigen::VectorXd radii = Eigen::VectorXd::Constant(11, 0.003);
  const std::vector<SolidBone> bones = shaft();
  const ClearSections clear = clear_of_bones(line, radii, 12, bones);
  EXPECT_EQ(clear.centers.col(0), line.col(0));
  // As far out as its radius and a gap.
  EXPECT_NEAR(clear.centers(0, 10), 0.0235, 1e-4);
  EXPECT_LT((clear.centers.col(10) - line.col(10)).norm(), 0.0096);
  const Points vertices = corners(clear);
  for (const Vec3 vertex : vertices.leftCols(11 * 12).colwise())
    EXPECT_GT(bones[0].distance.query(vertex).distance, 0.0002);
}

}  // namespace gracilis::opensim
