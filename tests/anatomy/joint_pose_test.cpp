#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/anatomy/pose_sequence.hpp>
#include <gracilis/core/errors.hpp>

#include <gtest/gtest.h>

namespace gracilis {
namespace {

//   world (body 0) ── hip at (0.1, 0.2, 0.3) ── thigh ── knee ── shank
Scene leg() {
  Scene scene;
  scene.bodies = {"pelvis", "thigh", "shank"};
  Joint hip{"hip", 0, 1, RigidTransform::Identity(), {}};
  hip.frame = Eigen::Translation3d(0.1, 0.2, 0.3) * Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized());
  hip.axes = {{"flexion", Vec3::UnitZ(), 0.03, -1, 2},
              {"adduction", Vec3::UnitX(), -0.08, -1, 1},
              {"rotation", Vec3::UnitY(), -0.09, -1, 1}};
  Joint knee{"knee", 1, 2, RigidTransform::Identity(), {{"knee_angle", Vec3::UnitX(), 0.2, -2, 0}}};
  knee.frame = Eigen::Translation3d(0.1, 0.2, -0.1);
  scene.joints = {hip, knee};
  return scene;
}

bool identity_to_the_last_bit(const RigidTransform& transform) {
  return transform.matrix().cwiseEqual(Eigen::Matrix4d::Identity()).all();
}

Motion motion(std::vector<std::string> coordinates, std::vector<Real> times, Eigen::MatrixXd values) {
  return {"test", std::move(coordinates), std::move(times), std::move(values)};
}

}  // namespace

TEST(JointPose, coordinates_are_listed_in_the_order_of_joints_and_axes) {
  EXPECT_EQ(coordinate_names(leg()), (std::vector<std::string>{"flexion", "adduction", "rotation", "knee_angle"}));
  EXPECT_EQ(capture_coordinates(leg()), (std::vector<Real>{0.03, -0.08, -0.09, 0.2}));
}

TEST(JointPose, the_capture_pose_is_the_identity_to_the_last_bit) {
  const Scene scene = leg();
  const Pose pose = pose_at(scene, capture_coordinates(scene));
  ASSERT_EQ(pose.bodies.size(), 3u);
  for (const RigidTransform& body : pose.bodies) EXPECT_TRUE(identity_to_the_last_bit(body));
}

TEST(JointPose, a_joint_turns_its_child_about_its_center_and_leaves_the_parent) {
  const Scene scene = leg();
  const Pose pose = pose_at(scene, std::vector<Real>{1, 0.2, -0.4, 0.2});
  EXPECT_TRUE(identity_to_the_last_bit(pose.bodies[0]));
  EXPECT_NEAR((pose.bodies[1] * Vec3(0.1, 0.2, 0.3) - Vec3(0.1, 0.2, 0.3)).norm(), 0, 1e-15);
  EXPECT_GT((pose.bodies[1] * Vec3(0, 0, 0)).norm(), 0.01);
}

TEST(JointPose, a_child_follows_its_parent_when_its_own_joint_stays_at_capture) {
  const Pose pose = pose_at(leg(), std::vector<Real>{1, 0.2, -0.4, 0.2});
  EXPECT_TRUE(pose.bodies[2].matrix().cwiseEqual(pose.bodies[1].matrix()).all());
}

TEST(JointPose, axes_are_body_fixed_and_applied_in_their_order) {
  Scene scene = leg();
  scene.joints.resize(1);
  scene.bodies.resize(2);
  for (JointAxis& axis : scene.joints[0].axes) axis.capture_value = 0;
  const RigidTransform& frame = scene.joints[0].frame;
  const Pose pose = pose_at(scene, std::vector<Real>{0.5, -0.3, 0.2});
  const RigidTransform expected = frame * Eigen::AngleAxisd(0.5, Vec3::UnitZ()) *
                                  Eigen::AngleAxisd(-0.3, Vec3::UnitX()) * Eigen::AngleAxisd(0.2, Vec3::UnitY()) *
                                  frame.inverse();
  EXPECT_TRUE(pose.bodies[1].isApprox(expected, 1e-14));
}

TEST(JointPose, poses_are_relative_to_the_capture_values) {
  // One axis: turning from 0.3 to 0.8 moves the child by 0.5.
  Scene scene;
  scene.bodies = {"a", "b"};
  scene.joints = {{"j", 0, 1, RigidTransform::Identity(), {{"q", Vec3::UnitZ(), 0.3, -1, 1}}}};
  const Pose pose = pose_at(scene, std::vector<Real>{0.8});
  EXPECT_NEAR((pose.bodies[1] * Vec3::UnitX() - Vec3(std::cos(0.5), std::sin(0.5), 0)).norm(), 0, 1e-15);
}

TEST(PoseSequence, frame_zero_is_the_capture_pose_and_the_ramp_takes_one_degree_per_frame_at_most) {
  Scene scene = leg();
  scene.motion = motion({"flexion"}, {0, 0.5}, Eigen::Vector2d(0.03 + radians(7.5), 1));
  const std::vector<Pose> poses = pose_sequence(scene);
  ASSERT_EQ(poses.size(), 1u + 8u + 1u);
  EXPECT_TRUE(identity_to_the_last_bit(poses[0].bodies[1]));
  for (int i = 1; i <= 8; ++i)
    EXPECT_NEAR(poses[i].coordinates[0] - poses[i - 1].coordinates[0], radians(7.5 / 8), 1e-15);
  EXPECT_EQ(poses[8].coordinates[0], 0.03 + radians(7.5));
  EXPECT_EQ(poses[9].coordinates[0], 1);
  EXPECT_EQ(poses[9].coordinates[1], -0.08) << "coordinates that the motion does not name keep their capture value";
}

TEST(PoseSequence, a_joint_that_carries_everything_makes_no_ramp_longer) {
  Scene scene = leg();
  scene.bodies.insert(scene.bodies.begin(), "ground");
  for (Joint& joint : scene.joints) ++joint.parent_body, ++joint.child_body;
  Joint root{"ground_pelvis", 0, 1, RigidTransform::Identity(), {{"pelvis_tx", Vec3::UnitX(), 0, -10, 10, true}}};
  scene.joints.insert(scene.joints.begin(), root);
  for (const Index body : {1, 2, 3}) {
    scene.bones.emplace_back();
    scene.bones.back().body = body;
  }
  Eigen::MatrixXd values(2, 2);
  values << 0.6, 0.03 + radians(2.5), 0.6, 0.03 + radians(2.5);
  scene.motion = motion({"pelvis_tx", "flexion"}, {0, 0.1}, values);
  EXPECT_EQ(pose_sequence(scene).size(), 1u + 3u + 1u);  // 2.5 degrees, not 600 mm
  scene.bones[0].body = 0;                               // now the pelvis moves against something
  EXPECT_EQ(pose_sequence(scene).size(), 1u + 600u + 1u);
}

TEST(PoseSequence, the_motion_keeps_its_times_and_the_ramp_comes_before) {
  Scene scene = leg();
  scene.motion = motion({"flexion"}, {2, 2.5, 3}, Eigen::Vector3d(0.5, 0.6, 0.7));
  scene.sequence.ramp_frames = 4;
  scene.sequence.hold_frames = 2;
  const std::vector<Pose> poses = pose_sequence(scene);
  ASSERT_EQ(poses.size(), 1u + 4u + 2u + 2u);
  for (std::size_t i = 0; i < poses.size(); ++i) EXPECT_NEAR(poses[i].time, 0.5 * Real(i), 1e-12);
  EXPECT_EQ(poses[8].coordinates, poses[6].coordinates);
}

TEST(PoseSequence, muscles_may_settle_in_the_first_pose) {
  Scene scene = leg();
  scene.motion = motion({"flexion"}, {2, 2.5, 3}, Eigen::Vector3d(0.5, 0.6, 0.7));
  scene.sequence.ramp_frames = 2;
  scene.sequence.settle_frames = 3;
  const std::vector<Pose> poses = pose_sequence(scene);
  ASSERT_EQ(poses.size(), 1u + 2u + 3u + 2u);
  for (std::size_t i = 0; i < poses.size(); ++i) EXPECT_NEAR(poses[i].time, -0.5 + 0.5 * Real(i), 1e-12);
  for (std::size_t i = 2; i <= 5; ++i) EXPECT_EQ(poses[i].coordinates[0], 0.5);
  EXPECT_EQ(poses[6].coordinates[0], 0.6);
}

TEST(PoseSequence, a_motion_that_starts_in_the_capture_pose_needs_no_ramp) {
  Scene scene = leg();
  scene.motion = motion({"flexion"}, {0, 1}, Eigen::Vector2d(0.03, 0.04));
  EXPECT_EQ(pose_sequence(scene).size(), 2u);
}

TEST(PoseSequence, the_return_ends_exactly_in_the_capture_pose) {
  Scene scene = leg();
  scene.motion = motion({"flexion", "knee_angle"}, {0}, Eigen::RowVector2d(0.6, -0.4));
  scene.sequence.return_to_capture = true;
  const std::vector<Pose> poses = pose_sequence(scene);
  ASSERT_GT(poses.size(), 3u);
  for (const RigidTransform& body : poses.back().bodies) EXPECT_TRUE(identity_to_the_last_bit(body));
}

TEST(PoseSequence, a_scene_without_motion_is_the_capture_pose_alone) { EXPECT_EQ(pose_sequence(leg()).size(), 1u); }

TEST(PoseSequence, is_never_longer_than_allowed) {
  Scene scene = leg();
  scene.motion = motion({"flexion"}, {0, 0.5}, Eigen::Vector2d(0.03 + radians(7.5), 1));
  EXPECT_EQ(pose_sequence(scene, 10).size(), 10u);
  EXPECT_THROW(pose_sequence(scene, 9), ConfigurationError);
  EXPECT_THROW(sequence_parts(scene, 9), ConfigurationError);
  scene.sequence.settle_frames = 1;
  EXPECT_THROW(pose_sequence(scene, 10), ConfigurationError);
  scene.motion.values(0, 0) = 1e300;
  EXPECT_THROW(pose_sequence(scene), ConfigurationError);
}

TEST(JointPose, a_translation_shifts_along_its_axis_in_the_frame_left_by_the_axes_before) {
  Scene scene;
  scene.bodies = {"ground", "press"};
  Joint joint;
  joint.child_body = 1;
  joint.frame = Eigen::Translation3d(0.1, 0, 0) * Eigen::AngleAxisd(radians(90), Vec3::UnitX());
  JointAxis turn, shift;
  turn.coordinate = "turn";
  shift.coordinate = "shift";
  shift.axis = Vec3::UnitX();
  shift.capture_value = 0.005;
  shift.translation = true;
  joint.axes = {turn, shift};
  scene.joints = {joint};
  EXPECT_TRUE(pose_at(scene, std::vector<Real>{0, 0.005}).bodies[1].matrix().isIdentity(0));
  const RigidTransform shifted = pose_at(scene, std::vector<Real>{0, 0.025}).bodies[1];
  EXPECT_LT((shifted * Vec3(1, 2, 3) - Vec3(1.02, 2, 3)).norm(), 1e-14);
  // A quarter turn about the joint's z, which is the world's -y, sends its x to the world's z.
  const RigidTransform both = pose_at(scene, std::vector<Real>{radians(90), 0.025}).bodies[1];
  EXPECT_LT((both * Vec3(0.1, 0, 0) - Vec3(0.1, 0, 0.02)).norm(), 1e-14);
}

}  // namespace gracilis
