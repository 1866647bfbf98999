#include <gracilis/anatomy/pose_sequence.hpp>

#include <gracilis/core/errors.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gracilis {
namespace {

using testing::ElementsAre;

constexpr SequenceParts parts = {4, 1, 6, 0, 2};  // frames 0 to 4, 5 to 10, 11 and 12

TEST(RecordedFrames, are_every_nth_and_the_last) {
  EXPECT_THAT(recorded_frames(parts, 5, true), ElementsAre(0, 5, 10, 12));
  EXPECT_THAT(recorded_frames(parts, 6, true), ElementsAre(0, 6, 12));
  EXPECT_EQ(recorded_frames(parts, 1, true).size(), 13u);
  EXPECT_THAT(recorded_frames(parts, 100, true), ElementsAre(0, 12));
}

TEST(RecordedFrames, without_ramps_are_the_capture_pose_and_the_motion) {
  EXPECT_THAT(recorded_frames(parts, 1, false), ElementsAre(0, 5, 6, 7, 8, 9, 10));
  EXPECT_THAT(recorded_frames(parts, 2, false), ElementsAre(0, 5, 7, 9, 10));
  const SequenceParts no_ramp = {0, 0, 3, 0, 0};
  EXPECT_THAT(recorded_frames(no_ramp, 1, false), ElementsAre(0, 1, 2));
  const SequenceParts no_motion = {0, 0, 1, 0, 0};
  EXPECT_THAT(recorded_frames(no_motion, 3, false), ElementsAre(0));
}

/// A pelvis that a ground joint carries with all that is there, and a hinge between two bones.
Scene two_bones() {
  Scene scene;
  scene.bodies = {"ground", "pelvis", "femur"};
  scene.bones = {{"pelvis", 1, {}}, {"femur", 2, {}}};
  scene.joints = {{"ground", 0, 1, RigidTransform::Identity(), {{"tilt", Vec3::UnitX(), 0, -pi, pi}}},
                  {"hip", 1, 2, RigidTransform::Identity(), {{"flexion", Vec3::UnitZ(), radians(5), -pi, pi}}}};
  scene.motion.coordinates = {"flexion", "unknown", "tilt"};
  scene.motion.times = {2, 2.5, 4};
  scene.motion.values.resize(3, 3);
  scene.motion.values << radians(15), 7, radians(80), radians(20), 7, radians(80), radians(8), 7, radians(80);
  return scene;
}

std::vector<Real> values_of(const std::vector<Pose>& poses, std::size_t coordinate) {
  std::vector<Real> values;
  for (const Pose& pose : poses) values.push_back(degrees(pose.coordinates[coordinate]));
  return values;
}

std::vector<Real> times_of(const std::vector<Pose>& poses) {
  std::vector<Real> times;
  for (const Pose& pose : poses) times.push_back(pose.time);
  return times;
}

auto near(const std::vector<Real>& values) { return testing::Pointwise(testing::DoubleNear(1e-9), values); }

TEST(PoseSequence, ramps_by_one_degree_of_what_moves_bones_against_each_other_holds_and_comes_back) {
  Scene scene = two_bones();
  scene.sequence = {0, 2, 1, true};
  const std::vector<Pose> poses = pose_sequence(scene);
  EXPECT_THAT(values_of(poses, 1), near({5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 15, 15, 20, 8, 8, 7, 6, 5}));
  const std::vector<Real> tilts = values_of(poses, 0);
  EXPECT_NEAR(tilts[5], 40, 1e-9) << "goes along";
  const SequenceParts found = sequence_parts(scene);
  EXPECT_EQ(found.ramp, 10);
  EXPECT_EQ(found.settle, 2);
  EXPECT_EQ(found.motion, 3);
  EXPECT_EQ(found.hold, 1);
  EXPECT_EQ(found.back, 3);
  EXPECT_EQ(found.count(), static_cast<int>(poses.size()));
  // A second apart on average, and so are the frames before and after.
  EXPECT_THAT(times_of(poses), near({-10, -9, -8, -7, -6, -5, -4, -3, -2, -1, 0, 1, 2, 2.5, 4, 5, 6, 7, 8}));
}

TEST(PoseSequence, the_motion_keeps_its_times_and_a_ramp_the_frames_that_it_is_given) {
  Scene scene = two_bones();
  scene.sequence.ramp_frames = 4;
  const std::vector<Pose> poses = pose_sequence(scene);
  EXPECT_THAT(values_of(poses, 1), near({5, 7.5, 10, 12.5, 15, 20, 8}));
  EXPECT_THAT(times_of(poses), near({-2, -1, 0, 1, 2, 2.5, 4}));
  EXPECT_EQ(poses[4].coordinates[1], radians(15)) << "exactly";
}

TEST(PoseSequence, a_motion_that_begins_in_the_capture_pose_has_no_ramp) {
  Scene scene = two_bones();
  scene.motion.values.row(0) << radians(5), 7, 0;
  EXPECT_EQ(sequence_parts(scene).ramp, 0);
  EXPECT_THAT(values_of(pose_sequence(scene), 1), near({5, 20, 8}));
}

TEST(PoseSequence, of_a_single_row_frames_are_a_sixtieth_of_a_second_apart_and_without_a_motion_there_is_one) {
  Scene scene = two_bones();
  scene.motion.times = {1};
  scene.motion.values = scene.motion.values.row(0).eval();
  scene.sequence = {1, 0, 2, false};
  EXPECT_THAT(times_of(pose_sequence(scene)), near({1 - 1.0 / 60, 1, 1 + 1.0 / 60, 1 + 2.0 / 60}));
  scene.motion = {};
  ASSERT_EQ(pose_sequence(scene).size(), 1u);
  EXPECT_NEAR(pose_sequence(scene)[0].coordinates[1], radians(5), 1e-15);
  EXPECT_EQ(sequence_parts(scene).count(), 1);
}

TEST(PoseSequence, more_frames_than_are_allowed_are_refused) {
  Scene scene = two_bones();
  scene.sequence = {0, 2, 1, true};
  EXPECT_NO_THROW(sequence_parts(scene, 19));
  EXPECT_THROW(sequence_parts(scene, 18), ConfigurationError);
  EXPECT_THROW(pose_sequence(scene, 18), ConfigurationError);
}

}  // namespace
}  // namespace gracilis
