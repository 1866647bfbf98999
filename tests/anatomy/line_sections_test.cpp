#include <gracilis/anatomy/sections/line_path.hpp>
#include <gracilis/anatomy/sections/line_sections.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gracilis {
namespace {

/// 0.2 m along z from body 0 to body 1, with tendons of 30 and 50 mm: a belly of 120 mm.
ActionLine straight_line() {
  ActionLine line;
  line.points = (Points(3, 2) << 0, 0, 0, 0, 0, 0.2).finished();
  line.bodies = {0, 1};
  line.rays = 6;
  line.shares = {0, 0.1, 0.15, 0.5, 0.75, 0.9, 1};
  line.origin_tendon = 0.03;
  line.tendon = 0.05;
  return line;
}

Pose lengthened(Real by) {
  Pose pose = capture_pose(2);
  pose.bodies[1].translation() = Vec3(0, 0, by);
  return pose;
}

void expect_heights(const LineSections& sections, Real longer, const std::vector<Real>& heights) {
  const PlacedSections placed = sections_at(sections, lengthened(longer));
  ASSERT_EQ(placed.centers.cols(), static_cast<Index>(heights.size()));
  for (std::size_t k = 0; k < heights.size(); ++k)
    EXPECT_LT((placed.centers.col(static_cast<Index>(k)) - Vec3(0, 0, heights[k])).norm(), 1e-12) << longer << ' ' << k;
}

LinePoint point_at(Index body, const Vec3& place) {
  LinePoint point;
  point.body = body;
  point.place = place;
  return point;
}

}  // namespace

TEST(LineSections, in_the_capture_pose_lie_at_their_shares) {
  const LineSections sections = line_sections(straight_line(), Vec3(0.01, 0, 0));
  EXPECT_NEAR(sections.length, 0.2, 1e-15);
  EXPECT_LT((sections.first_ray - Vec3(0.01, 0, 0)).norm(), 1e-15);
  expect_heights(sections, 0, {0, 0.02, 0.03, 0.1, 0.15, 0.18, 0.2});
}

TEST(LineSections, of_a_longer_line_keep_their_distance_from_its_ends_in_tendons_and_share_the_rest) {
  const LineSections sections = line_sections(straight_line(), Vec3(0.01, 0, 0));
  // The belly grows from 120 to 180 mm, and shrinks to 60 mm.
  expect_heights(sections, 0.06, {0, 0.02, 0.03, 0.03 + 0.07 * 1.5, 0.21, 0.24, 0.26});
  expect_heights(sections, -0.06, {0, 0.02, 0.03, 0.03 + 0.07 * 0.5, 0.09, 0.12, 0.14});
}

TEST(LineSections, of_a_line_that_leaves_no_room_for_the_belly_shrink_alike) {
  const LineSections sections = line_sections(straight_line(), Vec3(0.01, 0, 0));
  // A fifth of the belly is 24 mm.
  expect_heights(sections, 0.1041 - 0.2, {0, 0.02, 0.03, 0.03 + 0.07 * 0.0241 / 0.12, 0.0541, 0.0841, 0.1041});
  const Real scale = 0.1039 / 0.2;
  expect_heights(sections, 0.1039 - 0.2,
                 {0, 0.02 * scale, 0.03 * scale, 0.1 * scale, 0.15 * scale, 0.18 * scale, 0.2 * scale});
}

TEST(LineSections, without_tendons_all_share_the_line_and_with_nothing_else_all_scale) {
  ActionLine line = straight_line();
  line.tendon = line.origin_tendon = 0;
  expect_heights(line_sections(line, Vec3(0.01, 0, 0)), 0.1, {0, 0.03, 0.045, 0.15, 0.225, 0.27, 0.3});
  line.tendon = 0.2;
  expect_heights(line_sections(line, Vec3(0.01, 0, 0)), 0.1, {0, 0.03, 0.045, 0.15, 0.225, 0.27, 0.3});
}

TEST(LineSections, without_shares_lie_at_the_lines_points_with_every_part_halved) {
  ActionLine line = straight_line();
  line.shares.clear();
  line.tendon = line.origin_tendon = 0;
  line.points = (Points(3, 3) << 0, 0, 0.06, 0, 0, 0, 0, 0.04, 0.12).finished();
  line.bodies = {0, 0, 1};
  line.scaling = 1;
  const LineSections sections = line_sections(line, Vec3(0.01, 0, 0));
  const std::vector<Real> places = {0, 0.02, 0.04, 0.09, 0.14};
  ASSERT_EQ(sections.places.size(), places.size());
  for (std::size_t k = 0; k < places.size(); ++k) EXPECT_NEAR(sections.places[k], places[k], 1e-12);
  EXPECT_NEAR(sections.length, 0.14, 1e-12);
}

TEST(LineSections, the_first_ray_turns_with_the_first_body) {
  const LineSections sections = line_sections(straight_line(), Vec3(0.01, 0, 0));
  Pose pose = capture_pose(2);
  pose.bodies[0].linear() = Eigen::AngleAxisd(pi / 2, Vec3::UnitZ()).toRotationMatrix();
  const PlacedSections placed = sections_at(sections, pose);
  EXPECT_LT((placed.frames.ray(0, 0, 6) - Vec3::UnitY()).norm(), 1e-12);
  const RigidTransform frame = placed.frame(3);
  EXPECT_LT((frame.translation() - Vec3(0, 0, 0.1)).norm(), 1e-12);
  EXPECT_LT((frame.linear().col(0) - Vec3::UnitY()).norm(), 1e-12);
  EXPECT_EQ(line_sections(straight_line(), Vec3::Zero()).first_ray, Vec3::UnitX()) << "a corner in the center";
}

TEST(LineSections, vertices_belong_to_their_section_and_those_that_close_the_ends_to_the_outer_ones) {
  for (Index v = 0; v < 18; ++v) EXPECT_EQ(section_of_vertex(v, 3, 6), v / 6);
  EXPECT_EQ(section_of_vertex(18, 3, 6), 0);
  EXPECT_EQ(section_of_vertex(19, 3, 6), 2);
}

TEST(LinePath, points_are_there_within_their_range_and_a_little_beyond) {
  ActionLine line = straight_line();
  line.path.points = {point_at(0, Vec3::Zero()), point_at(0, Vec3(0.02, 0, 0.1)), point_at(1, Vec3(0, 0, 0.2))};
  line.path.points[1].condition.index = 1;
  line.path.points[1].range_min = 0.5;
  line.path.points[1].range_max = 1;
  Pose pose = lengthened(0);
  const auto count = [&](Real value) {
    pose.coordinates = {0.7, value};
    return line_at(line, pose).cols();
  };
  EXPECT_EQ(count(0.5 - 9e-6), 3);
  EXPECT_EQ(count(0.5 - 2e-5), 2);
  EXPECT_EQ(count(1 + 9e-6), 3);
  EXPECT_EQ(count(1 + 2e-5), 2);
  pose.coordinates.clear();
  line.path.points[1].condition.capture = 0.75;
  EXPECT_EQ(line_at(line, pose).cols(), 3) << "a coordinate that is not told is as captured";
}

TEST(LinePath, points_move_with_their_bodies_or_as_their_curves_say) {
  ActionLine line = straight_line();
  line.path.points = {point_at(0, Vec3(0, 0, 0.01)), point_at(1, Vec3(0, 0, 0.21))};
  LinePoint& moving = line.path.points[0];
  moving.moving = true;
  moving.frame.translation() = Vec3(1, 0, 0);
  for (std::size_t i = 0; i < 3; ++i) {
    moving.moves_with[i].index = static_cast<Index>(i);
    moving.moves_to[i] = {{0, 1}, {0, 1}, {1, 1}};
  }
  Pose pose = lengthened(0.05);
  pose.bodies[0].translation() = Vec3(0, 2, 0);
  pose.coordinates = {0.25, 0.5, 0.75};
  const Points found = line_at(line, pose);
  ASSERT_EQ(found.cols(), 2);
  EXPECT_LT((found.col(0) - Vec3(1.25, 2.5, 0.75)).norm(), 1e-12);
  EXPECT_LT((found.col(1) - Vec3(0, 0, 0.26)).norm(), 1e-12);
}

TEST(LinePath, goes_around_surfaces_in_steps_of_five_degrees_and_without_two_points_as_the_line_does) {
  ActionLine line = straight_line();
  line.path.points = {point_at(0, Vec3(0.03, 0.001, 0)), point_at(1, Vec3(-0.03, 0.001, 0))};
  PlacedWrap wrap;
  wrap.surface.radius = 0.01;
  wrap.surface.length = 1;
  wrap.last_point = 1;
  line.path.wraps = {wrap};
  const Points around = line_at(line, capture_pose(2));
  ASSERT_GT(around.cols(), 8);
  for (Index i = 1; i + 2 < around.cols(); ++i) {
    EXPECT_NEAR(around.col(i).head<2>().norm(), 0.01, 1e-9);
    EXPECT_LE((around.col(i + 1) - around.col(i)).norm(), 2 * 0.01 * std::sin(radians(2.5)) + 1e-9);
  }
  line.path.points.pop_back();
  EXPECT_TRUE(line_at(line, lengthened(0.1)).isApprox((Points(3, 2) << 0, 0, 0, 0, 0, 0.3).finished(), 1e-15));
}

}  // namespace gracilis
