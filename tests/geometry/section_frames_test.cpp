#include <gracilis/geometry/section_frames.hpp>

#include <gracilis/geometry/rotations.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace gracilis {
namespace {

Points line_through(const std::vector<Vec3>& places) {
  Points line(3, static_cast<Index>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) line.col(static_cast<Index>(i)) = places[i];
  return line;
}

Eigen::Matrix3d some_rotation(std::mt19937& chance) {
  std::normal_distribution<Real> normal;
  return Eigen::Quaterniond(normal(chance), normal(chance), normal(chance), normal(chance)).normalized().matrix();
}

}  // namespace

TEST(SubdividedLine, every_part_is_halved_so_often_and_given_points_stay_to_the_bit) {
  const Points line = line_through({{0.1, 0.2, 0.3}, {0.7, 0.2, 0.3}, {0.7, 1.1, -0.3}});
  EXPECT_EQ(subdivide_line(line, 0), line);
  for (const int scaling : {1, 3}) {
    const Index parts = Index(1) << scaling;
    const Points fine = subdivide_line(line, scaling);
    ASSERT_EQ(fine.cols(), 2 * parts + 1);
    for (Index i = 0; i < 3; ++i) EXPECT_EQ(fine.col(i * parts), line.col(i));
    for (Index i = 0; i < 2 * parts; ++i) {
      const Index part = i / parts;
      const Vec3 step = (line.col(part + 1) - line.col(part)) / parts;
      EXPECT_LT((fine.col(i + 1) - fine.col(i) - step).norm(), 1e-15) << i;
    }
  }
}

TEST(SectionFrames, normals_are_differences_as_the_planes_say) {
  const Points line = line_through({{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {1, 2, 3}});
  const auto normals = [&](SectionPlanes planes) { return section_frames(line, Vec3(0, 1, 1), planes).normals; };
  const Eigen::Matrix3Xd centered = normals(SectionPlanes::centered), forward = normals(SectionPlanes::forward),
                         fixed = normals(SectionPlanes::fixed);
  const std::vector<Vec3> between = {{1, 0, 0}, {1, 2, 0}, {0, 2, 3}, {0, 0, 3}},
                          ahead = {{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {0, 0, 3}};
  for (Index k = 0; k < 4; ++k) {
    const auto at = static_cast<std::size_t>(k);
    EXPECT_LT((centered.col(k) - between[at].normalized()).norm(), 1e-15) << k;
    EXPECT_LT((forward.col(k) - ahead[at].normalized()).norm(), 1e-15) << k;
    EXPECT_EQ(fixed.col(k), Vec3(0, -1, 0)) << k;
  }
}

TEST(SectionFrames, where_a_line_turns_back_on_itself_the_part_before_stands_in) {
  const Points line = line_through({{0, 0, 0}, {0, 0.02, 0}, {0, 0, 0}, {0.01, 0, 0}});
  const SectionFrames frames = section_frames(line, Vec3::UnitX());
  EXPECT_LT((frames.normals.col(1) - Vec3::UnitY()).norm(), 1e-15);
}

TEST(SectionFrames, axes_are_right_handed_and_rays_turn_about_the_normal) {
  const Points line = line_through({{0, 0, 0}, {0.1, 0.02, 0}, {0.2, 0.1, 0.05}, {0.25, 0.2, 0.2}});
  const SectionFrames frames = section_frames(line, Vec3(0.3, 1, 0.2));
  for (Index k = 0; k < 4; ++k) {
    const Eigen::Matrix3d axes = frames.axes(k);
    EXPECT_LT((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_NEAR(axes.determinant(), 1, 1e-12);
    EXPECT_EQ(axes.col(2), frames.normals.col(k));
    EXPECT_EQ(axes.col(0), frames.first_rays.col(k));
    for (Index ray = 0; ray < 6; ++ray) {
      const Vec3 turned = Eigen::AngleAxisd(pi / 3 * ray, frames.normals.col(k)) * Vec3(frames.first_rays.col(k));
      EXPECT_LT((frames.ray(k, ray, 6) - turned).norm(), 1e-12) << k << ' ' << ray;
    }
  }
}

TEST(SectionFrames, first_rays_are_carried_on_by_the_smallest_turn) {
  // In a plane nothing twists: what is across the plane stays, what lies in it turns with the line.
  std::vector<Vec3> arc;
  for (int i = 0; i <= 20; ++i) arc.emplace_back(std::cos(0.1 * i), std::sin(0.1 * i), 0);
  const Points line = line_through(arc);
  const SectionFrames across = section_frames(line, Vec3::UnitZ()), outwards = section_frames(line, Vec3(1, 0.1, 0));
  for (Index k = 0; k <= 20; ++k) {
    EXPECT_LT((across.first_rays.col(k) - Vec3::UnitZ()).norm(), 1e-12) << k;
    const Vec3 right = Vec3(outwards.normals.col(k)).cross(Vec3::UnitZ());
    EXPECT_LT((outwards.first_rays.col(k) - right).norm(), 1e-12) << k;
  }
}

TEST(SectionFrames, a_first_ray_along_the_line_is_replaced_and_one_aslant_is_laid_into_the_plane) {
  const Points line = line_through({{0, 0, 0}, {0, 0, 1}, {0, 0, 2}});
  const SectionFrames along = section_frames(line, 5 * Vec3::UnitZ());
  for (Index k = 0; k < 3; ++k) {
    EXPECT_NEAR(along.first_rays.col(k).norm(), 1, 1e-12);
    EXPECT_NEAR(along.first_rays(2, k), 0, 1e-12);
  }
  const SectionFrames aslant = section_frames(line, Vec3(3, 4, 7));
  for (Index k = 0; k < 3; ++k) EXPECT_LT((aslant.first_rays.col(k) - Vec3(0.6, 0.8, 0)).norm(), 1e-12);
}

TEST(Rotations, the_smallest_turn_leaves_what_is_across_both) {
  std::mt19937 chance(7);
  std::normal_distribution<Real> normal;
  for (int i = 0; i < 20; ++i) {
    const Vec3 from(normal(chance), normal(chance), normal(chance)), to(normal(chance), normal(chance), normal(chance));
    const Eigen::Quaterniond turn = turn_from_to(from, to);
    EXPECT_LT((turn * from.normalized() - to.normalized()).norm(), 1e-12);
    EXPECT_LT((turn * from.cross(to) - from.cross(to)).norm(), 1e-12 * from.norm() * to.norm());
  }
  EXPECT_LT((turn_from_to(Vec3::UnitX(), -2 * Vec3::UnitX()) * Vec3::UnitX() + Vec3::UnitX()).norm(), 1e-12);
}

TEST(Rotations, of_a_stretched_rotation_the_nearest_is_the_rotation_and_of_a_reflection_none_is_nearer) {
  std::mt19937 chance(8);
  std::uniform_real_distribution<Real> stretch(0.5, 2);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Matrix3d rotation = some_rotation(chance), axes = some_rotation(chance);
    const Vec3 stretches(stretch(chance), stretch(chance), stretch(chance));
    const Eigen::Matrix3d stretched = rotation * axes * stretches.asDiagonal() * axes.transpose();
    EXPECT_LT((nearest_rotation(stretched) - rotation).norm(), 1e-12);
    const Eigen::Matrix3d mirrored = -stretched, found = nearest_rotation(mirrored);
    EXPECT_NEAR(found.determinant(), 1, 1e-12);
    EXPECT_LT((found * found.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    for (int other = 0; other < 200; ++other)
      EXPECT_LE((found - mirrored).norm(), (some_rotation(chance) - mirrored).norm() + 1e-12);
  }
}

TEST(Rotations, the_rigid_motion_between_moved_points_is_that_motion_and_between_equal_ones_nothing) {
  std::mt19937 chance(9);
  std::normal_distribution<Real> normal;
  Points from(3, 12);
  for (Index i = 0; i < 12; ++i) from.col(i) = Vec3(normal(chance), normal(chance), normal(chance));
  RigidTransform motion = RigidTransform::Identity();
  motion.linear() = some_rotation(chance);
  motion.translation() = Vec3(1, -2, 3);
  const Points to = (motion.linear() * from).colwise() + Vec3(motion.translation());
  EXPECT_LT((rigid_motion(from, to).matrix() - motion.matrix()).norm(), 1e-12);
  EXPECT_EQ(rigid_motion(from, from).matrix(), Eigen::Matrix4d::Identity());
  // Grown points are only moved: no scale is taken in.
  const Points grown = 3 * to;
  EXPECT_LT((rigid_motion(from, grown).linear() - motion.linear()).norm(), 1e-12);
  EXPECT_LT((rigid_motion(from, grown).translation() + motion.linear() * Vec3(from.rowwise().mean()) -
             Vec3(grown.rowwise().mean()))
                .norm(),
            1e-12);
}

}  // namespace gracilis
