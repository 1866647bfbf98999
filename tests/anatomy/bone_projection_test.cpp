#include <gracilis/anatomy/overlap/bone_projection.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

namespace gracilis {

TEST(BoneProjection, points_keep_margins_of_their_own) {
  const Scene scene = tube_scene();
  Points rest(3, 4), now(3, 4);
  for (Index p = 0; p < 4; ++p) rest.col(p) = Vec3(0.025, 0, 0.05);  // 10 mm from the upper bone
  for (Index p = 0; p < 4; ++p) now.col(p) = Vec3(0.014, 0, 0.05);   // 1 mm in it
  const BoneProjection bones(scene, rest, {-1, -1, -1, 0}, tube_fields(), {0, 0.002, 0.02, 0.005}, true);
  EXPECT_GE(bones.push_out(flexed(scene, 0), now), 3);
  EXPECT_NEAR(now(0, 0), 0.015, 2e-5);
  EXPECT_NEAR(now(0, 1), 0.017, 2e-5);
  EXPECT_NEAR(now(0, 2), 0.025, 2e-5) << "no more than there is at rest";
  EXPECT_EQ(now(0, 3), 0.014) << "fixed";
}

/// Points 1 mm in the upper bone's front, 1 mm before it, and 1 mm in the lower bone's front; all free.
static Points around_bones() { return (Points(3, 3) << 0.014, 0.016, 0.014, 0, 0, 0, 0.05, 0.05, -0.05).finished(); }

static BoneProjection keeping(const Scene& scene, Real margin) {
  return {scene, around_bones(), {-1, -1, -1}, tube_fields(), {margin, margin, margin}, false};
}

TEST(BoneProjection, pushes_each_point_out_of_the_bone_where_the_bone_is_now_and_counts_it_once) {
  const Scene scene = tube_scene();
  const BoneProjection bones = keeping(scene, 0.0005);
  Points points = around_bones();
  EXPECT_EQ(bones.push_out(capture_pose(2), points), 2);
  EXPECT_LT((points.col(0) - Vec3(0.0155, 0, 0.05)).norm(), 2e-5);
  EXPECT_EQ(points.col(1), around_bones().col(1));
  EXPECT_LT((points.col(2) - Vec3(0.0155, 0, -0.05)).norm(), 2e-5);
  EXPECT_EQ(bones.push_out(capture_pose(2), points), 0) << "they keep their gap now";
  Pose pose = capture_pose(2);
  pose.bodies[1] = Eigen::Translation3d(0, 0.2, 0) * RigidTransform(Eigen::AngleAxisd(pi / 2, Vec3::UnitZ()));
  Points turned = around_bones();
  turned.col(2) = pose.bodies[1] * Vec3(turned.col(2));
  bones.push_out(pose, turned);
  EXPECT_LT((turned.col(2) - pose.bodies[1] * Vec3(0.0155, 0, -0.05)).norm(), 2e-5);
}

TEST(BoneProjection, takes_points_back_on_the_way_that_they_came_as_far_as_they_must) {
  const Scene scene = tube_scene();
  const BoneProjection bones = keeping(scene, 0.0005);
  Points points = around_bones(), began = points;
  began.col(0) += Vec3(0.003, 0, 0.004);  // aslant: 5 mm of way lead 3 mm out
  began.col(2).x() = 0.0145;              // began in the bone
  EXPECT_EQ(bones.take_back(capture_pose(2), began, points), 2);
  EXPECT_NEAR(points(0, 0), 0.0155, 5e-5);
  EXPECT_NEAR(points(2, 0) - 0.05, (points(0, 0) - 0.014) * 4 / 3, 1e-9) << "on its way";
  EXPECT_EQ(points.col(1), around_bones().col(1));
  EXPECT_EQ(points.col(2), began.col(2)) << "no further than it began";
}

TEST(BoneProjection, takes_points_in_a_bone_along_with_it) {
  const Scene scene = tube_scene();
  const BoneProjection bones = keeping(scene, 0.0005);
  Pose last = capture_pose(2), now = capture_pose(2);
  last.bodies[0].translation() = Vec3(0, 0.001, 0);
  now.bodies[0].translation() = Vec3(0, 0.003, 0);
  Points points = around_bones(), before = points;
  before.col(0) = Vec3(0.02, 0.01, 0.05);
  EXPECT_EQ(bones.take_along(last, now, before, points), 2);
  EXPECT_LT((points.col(0) - Vec3(0.02, 0.012, 0.05)).norm(), 1e-12) << "by what the bone moved";
  EXPECT_EQ(points.col(1), around_bones().col(1));
  EXPECT_LT((points.col(2) - before.col(2)).norm(), 1e-12) << "this bone stands still";
}

TEST(BoneProjection, of_no_points_pushes_none) {
  Points none(3, 0);
  EXPECT_EQ(BoneProjection().push_out(capture_pose(2), none), 0);
}

}  // namespace gracilis
