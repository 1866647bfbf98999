#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/core/stop.hpp>
#include <gracilis/simulate/measures.hpp>
#include <gracilis/simulate/pose_steps.hpp>
#include <gracilis/simulate/run.hpp>
#include <gracilis/simulate/wrong_side.hpp>

#include "scenes_for_tests.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <limits>

namespace gracilis {
namespace {

/// An upper arm with a hinge: a straight bone with a square section of 24 mm along z, from 0 down to -0.3 m, and a
/// shorter one below it; a spindle in front of them (+x), 1 mm clear, from near the top to the lower bone:
///
///      z = 0   ┌─┐
///              │ │(   spindle, 8 mm thick at its ends, 30 mm in its middle
///              │ │ )
///              │ │(
///     -0.3     └─┘
///              ┌─┐    lower bone, turns about y
Scene arm(int along = 60) {
  Scene scene;
  scene.name = "arm";
  scene.bodies = {"upper", "lower"};
  scene.bones = {{"upper", 0, shapes::box({-0.012, -0.012, -0.295}, {0.012, 0.012, 0})},
                 {"lower", 1, shapes::box({-0.012, -0.012, -0.5}, {0.012, 0.012, -0.305})}};
  scene.joints = {{"hinge", 0, 1, RigidTransform::Identity(), {{"flexion", Vec3::UnitY(), 0, -radians(150), 0}}}};
  scene.joints[0].frame = Eigen::Translation3d(0, 0, -0.3) * RigidTransform::Identity();
  Muscle muscle;
  muscle.name = "spindle";
  muscle.surface = shapes::cylinder(1, 0.32, 20, along);
  Attachment origin{"upper end", AttachmentEnd::origin, 0, {}, false};
  Attachment insertion{"lower end", AttachmentEnd::insertion, 1, {}, false};
  for (Index v = 0; v < muscle.surface.vertex_count(); ++v) {
    auto p = muscle.surface.vertices.col(v);
    const Real share = p.z() / 0.32, radius = 0.004 + 0.011 * std::sin(pi * share);
    if (share < 0.04) insertion.vertices.push_back(v);
    if (share > 0.96) origin.vertices.push_back(v);
    p = Vec3(0.013 + radius * (1 + p.x()), radius * p.y(), p.z() - 0.34);
  }
  muscle.attachments = {origin, insertion};
  scene.muscles = {muscle};
  return scene;
}

Real share_along(const Vec3& p) { return std::clamp((-0.02 - p.z()) / 0.32, 0.0, 1.0); }

Frame frame_of(const Scene& scene, const std::function<Vec3(const Vec3&)>& moved, Real angle = 0) {
  Frame frame = capture_frame(scene, flexed(scene, angle));
  for (auto p : frame.muscles[0].points.colwise()) p = moved(p);
  return frame;
}

MuscleMeasures measured(const Scene& scene, const Frame& frame) { return Measurer(scene).measure(frame).at(0); }

/// Turns what lies between the ends about the upper bone's axis, by `angle` in the middle.
Vec3 turned_about_bone(const Vec3& p, Real angle) {
  const Real part = std::min(1.0, 3 * std::sin(pi * share_along(p)));
  return Eigen::AngleAxisd(part * angle, Vec3::UnitZ()) * p;
}

}  // namespace

TEST(Places, nothing_is_missed_in_the_capture_pose) {
  const Scene scene = arm();
  const MuscleMeasures measures = measured(scene, frame_of(scene, [](const Vec3& p) { return p; }));
  EXPECT_EQ(measures.belly_off_place, 0);
  EXPECT_EQ(measures.wrong_side, 0);
  EXPECT_NEAR(measures.slack, 0, 1e-3);
}

TEST(Places, a_muscle_turned_to_the_other_side_of_the_bone_is_on_its_wrong_side) {
  const Scene scene = arm();
  const MuscleMeasures behind =
      measured(scene, frame_of(scene, [](const Vec3& p) { return turned_about_bone(p, radians(175)); }));
  EXPECT_GT(behind.wrong_side, 0.9);
  EXPECT_THAT(missed_gates(behind, {}), testing::Contains(testing::HasSubstr("wrong side")));
  const MuscleMeasures beside =
      measured(scene, frame_of(scene, [](const Vec3& p) { return turned_about_bone(p, radians(60)); }));
  EXPECT_EQ(beside.wrong_side, 0);
}

TEST(Places, a_muscle_that_swings_off_is_off_its_place) {
  const Scene scene = arm();
  const MuscleMeasures measures = measured(scene, frame_of(scene, [](const Vec3& p) -> Vec3 {
                                             return p + Vec3(0.04 * std::sin(pi * share_along(p)), 0, 0);
                                           }));
  EXPECT_NEAR(measures.belly_off_place, 0.04 * 0.955, 0.003) << "the mean of the sine over the middle third";
  EXPECT_EQ(measures.wrong_side, 0);
  EXPECT_THAT(missed_gates(measures, {}), testing::Contains(testing::HasSubstr("off its place")));
}

TEST(Places, a_belly_pulled_straight_off_its_bone_by_the_joint_is_in_its_place) {
  Scene scene = arm();
  // Inserted 0.13 m below the hinge, so that the straight way leaves the upper bone as the joint closes.
  for (auto p : scene.muscles[0].surface.vertices.colwise()) p.z() = -0.02 + (p.z() + 0.02) * 1.3;
  const Real angle = -radians(60);
  const Vec3 hinge(0, 0, -0.3), end(0.017, 0, -0.436);
  const Vec3 moved = hinge + Eigen::AngleAxisd(angle, Vec3::UnitY()) * (end - hinge) - end;
  ASSERT_GT(moved.x(), 0.05);
  const auto share = [](const Vec3& p) { return std::clamp((-0.02 - p.z()) / 0.416, 0.0, 1.0); };
  const auto off_place = [&](const Vec3& aside) {
    const Frame frame = frame_of(
        scene, [&](const Vec3& p) -> Vec3 { return p + share(p) * moved + std::sin(pi * share(p)) * aside; }, angle);
    return measured(scene, frame).belly_off_place;
  };
  EXPECT_LT(off_place(Vec3::Zero()), 0.006) << "it is sheared, not turned";
  EXPECT_GT(off_place({0.04, 0, 0}), 0.025) << "bowed further";
}

TEST(Places, a_muscle_that_slides_by_5_millimetres_meets_all_gates) {
  const Scene scene = arm();
  for (const Vec3& way : {Vec3(0, 0, 0.005), Vec3(0, 0.005, 0)}) {
    const MuscleMeasures measures = measured(scene, frame_of(scene, [&](const Vec3& p) -> Vec3 {
                                               const Real s = share_along(p);
                                               return s < 0.05 || s > 0.95 ? p : Vec3(p + way);
                                             }));
    EXPECT_LT(measures.belly_off_place, 0.002);
    EXPECT_EQ(measures.wrong_side, 0);
    EXPECT_LT(measures.slack, 0.05);
  }
}

/// As a correct elbow flexes: what lies on the upper bone comes nearer to its top, half of what the muscle loses, and
/// gets thicker on the side away from the bone; what follows bends with the joint.
TEST(Places, a_belly_that_shortens_and_thickens_in_place_meets_all_gates) {
  const Scene scene = arm();
  const Real angle = -radians(90), ratio = 0.83, thicker = std::sqrt(1 / ratio);
  const Pose pose = flexed(scene, angle);
  const Frame frame = frame_of(
      scene,
      [&](const Vec3& p) -> Vec3 {
        const Real s = share_along(p);
        if (s < 0.04) return p;
        if (s > 0.96) return pose.bodies[1] * p;
        Vec3 q = p;
        q.x() = 0.013 + thicker * (p.x() - 0.013);
        q.y() = thicker * p.y();
        q.z() = -0.0328 + ratio * (p.z() + 0.0328);
        return q;
      },
      angle);
  const MuscleMeasures measures = measured(scene, frame);
  EXPECT_LT(measures.belly_off_place, 1e-4);
  EXPECT_EQ(measures.wrong_side, 0);
  EXPECT_LT(measures.slack, 0.05);
}

TEST(Places, what_thickening_does_not_explain_counts) {
  const Scene scene = arm();
  const auto thick = [](const Vec3& p) -> Vec3 { return {0.013 + 1.3 * (p.x() - 0.013), 1.3 * p.y(), p.z()}; };
  const MuscleMeasures measures = measured(scene, frame_of(scene, thick));
  EXPECT_GT(measures.belly_off_place, 0.0005) << "as long as before, and thicker all the same";
  EXPECT_LT(measures.belly_off_place, 0.0027) << "0.3 of at most 9 mm";
}

TEST(Places, a_belly_that_lies_on_nothing_is_held_against_what_is_nearest) {
  Scene scene = arm();
  scene.muscles[0].surface.vertices.row(0).array() += 0.03;
  const auto away = [](const Vec3& p) -> Vec3 { return p + Vec3(0.02 * std::sin(pi * share_along(p)), 0, 0); };
  EXPECT_NEAR(measured(scene, frame_of(scene, away)).belly_off_place, 0.02 * 0.955, 0.002);
}

TEST(Places, a_belly_that_lay_on_another_muscle_may_follow_it_but_not_leave_it) {
  Scene scene = arm();
  scene.muscles.push_back(scene.muscles[0]);
  scene.muscles[1].name = "over it";
  scene.muscles[1].surface.vertices.row(0).array() += 0.031;
  const auto lifted = [&](bool both) {
    Frame frame = capture_frame(scene, flexed(scene, 0));
    for (std::size_t m = both ? 0 : 1; m < 2; ++m)
      for (auto p : frame.muscles[m].points.colwise()) p.x() += 0.03 * std::sin(pi * share_along(p));
    return Measurer(scene).measure(frame);
  };
  EXPECT_NEAR(lifted(false)[1].belly_off_place, 0.03 * 0.955, 0.004);
  EXPECT_EQ(lifted(false)[0].belly_off_place, 0) << "it lies on the bone as before";
  EXPECT_LT(lifted(true)[1].belly_off_place, 0.001);
  EXPECT_GT(lifted(true)[0].belly_off_place, 0.01) << "its side on the bone has come off";
}

TEST(Places, a_zigzag_20_percent_longer_is_not_taut) {
  const Scene scene = arm(240);
  // Two waves to the sides over nine tenths of the length. A sine whose steepest slope is 1 is 1.216 times as long as
  // its axis (a complete elliptic integral).
  const Real amplitude = 0.9 * 0.32 / (4 * pi);
  const MuscleMeasures measures = measured(scene, frame_of(scene, [&](const Vec3& p) -> Vec3 {
                                             const Real s = std::clamp((share_along(p) - 0.05) / 0.9, 0.0, 1.0);
                                             return p + Vec3(0, amplitude * std::sin(4 * pi * s), 0);
                                           }));
  EXPECT_NEAR(measures.slack, 0.2, 0.03);
  EXPECT_THAT(missed_gates(measures, {}), testing::Contains(testing::HasSubstr("longer than taut")));
}

TEST(Places, a_line_no_longer_than_at_rest_is_not_slack) {
  const LineBesideWay rest{0.1, 0.1, 0, 0.01};
  EXPECT_EQ(slack_of({0.1, 0.05, 0, 0.01}, rest), 0);
  EXPECT_NEAR(slack_of({0.12, 0.1, 0, 0.01}, rest), 0.2, 1e-12);
  EXPECT_NEAR(slack_of({0.12, 0.1, 1, 0.01}, rest), 0.12 / 0.11 - 1, 1e-12) << "around a bend at 10 mm from it";
  EXPECT_NEAR(slack_of({0.12, 0.1, 0, 0.01}, {0.11, 0.1, 0, 0.01}), 0.12 / 0.11 - 1, 1e-12) << "curved at rest";
}

TEST(Places, muscles_without_ends_or_bones_are_neutral) {
  Scene scene = arm();
  scene.muscles[0].attachments.pop_back();
  const auto swung = [](const Vec3& p) -> Vec3 { return p + Vec3(0.05, 0, 0); };
  MuscleMeasures measures = measured(scene, frame_of(scene, swung));
  EXPECT_EQ(measures.belly_off_place, 0);
  EXPECT_EQ(measures.wrong_side, 0);
  EXPECT_EQ(measures.slack, 0);
  scene = arm();
  scene.bones.clear();
  measures = measured(scene, frame_of(scene, swung));
  EXPECT_EQ(measures.belly_off_place, 0);
  EXPECT_EQ(measures.wrong_side, 0);
}

TEST(Places, are_the_same_for_any_number_of_threads_and_when_a_run_goes_on) {
  const Scene scene = arm();
  const auto shape = [](const Vec3& p) { return turned_about_bone(p, radians(100)); };
  Measurer whole(scene);
  MuscleMeasures last;
  for (int i = 0; i <= 20; ++i) last = whole.measure(frame_of(scene, shape, -radians(4 * i))).at(0);
  const ThreadLimit one(1);
  Measurer resumed(scene);
  for (int i = 0; i < 20; ++i) resumed.pass(flexed(scene, -radians(4 * i)));
  const MuscleMeasures now = resumed.measure(frame_of(scene, shape, -radians(80))).at(0);
  EXPECT_EQ(now.belly_off_place, last.belly_off_place);
  EXPECT_EQ(now.wrong_side, last.wrong_side);
  EXPECT_EQ(now.slack, last.slack);
  EXPECT_GT(now.slack, 0);
}

TEST(TautWays, keep_their_side_of_a_bone_through_a_jump_of_pose) {
  const Scene scene = arm();
  std::vector<SignedDistance> exact;
  for (const Bone& bone : scene.bones) exact.emplace_back(bone.surface);
  const BoneSpace space(scene, exact);
  TautWays ways(space, 2, TrackedLines(scene, nullptr).rest());
  ways.follow(flexed(scene, radians(110)));  // backwards: the string is drawn over the front of the joint
  for (const TautWay& way : ways.of(0)) {
    int beside_bone = 0;
    for (const Vec3 p : way.points.colwise()) {
      if (p.z() < -0.29 || p.z() > -0.05) continue;
      ++beside_bone;
      EXPECT_GT(p.x(), 0.0105) << "a cell's rounding of the edge within its front";
    }
    EXPECT_GT(beside_bone, 10);
    EXPECT_LT((way.points.leftCols(1) - way.rest_first).norm(), 1e-12);
  }
}

TEST(TautWays, are_straight_where_no_bone_is_in_the_way) {
  const Scene scene = arm();
  std::vector<SignedDistance> exact;
  for (const Bone& bone : scene.bones) exact.emplace_back(bone.surface);
  const BoneSpace space(scene, exact);
  TautWays ways(space, 2, TrackedLines(scene, nullptr).rest());
  ways.follow(flexed(scene, -radians(90)));
  for (const TautWay& way : ways.of(0)) {
    const Real straight = (way.points.rightCols(1) - way.points.leftCols(1)).norm();
    EXPECT_NEAR(polyline_length(way.points), straight, 1e-3 * straight);
  }
}

TEST(WrongSide, is_told_from_cutting_a_corner_or_passing_a_ball) {
  Scene scene = arm();
  scene.bones.push_back({"ball", 0, shapes::sphere({0.3, 0, 0}, 0.025, 4)});
  std::vector<SignedDistance> exact;
  for (const Bone& bone : scene.bones) exact.emplace_back(bone.surface);
  const BoneSpace space(scene, exact);
  const PlacedBones bones(space, std::vector<RigidTransform>(2, RigidTransform::Identity()));
  EXPECT_TRUE(is_across(bones, 0, {0.02, 0, -0.15}, {-0.02, 0, -0.15}));
  EXPECT_TRUE(is_across(bones, 0, {0.02, 0, -0.15}, {-0.06, 0.02, -0.14}));
  EXPECT_FALSE(is_across(bones, 0, {0.02, 0, -0.15}, {0, 0.02, -0.15})) << "around one edge";
  EXPECT_FALSE(is_across(bones, 0, {0.02, 0, -0.15}, {0.06, 0, -0.15})) << "in front of it";
  EXPECT_FALSE(is_across(bones, 0, {0.02, 0, -0.01}, {-0.02, 0, -0.01})) << "slides off over the end";
  EXPECT_FALSE(is_across(bones, 2, {0.27, 0, 0}, {0.33, 0, 0})) << "slides over a ball";
}

TEST(PoseSteps, turn_bodies_about_their_joint) {
  const Scene scene = arm();
  const auto steps = pose_steps(flexed(scene, 0).bodies, flexed(scene, radians(-60)).bodies, radians(2), 0.005);
  ASSERT_EQ(steps.size(), 30u);
  const Vec3 center(0, 0, -0.3);
  for (const auto& bodies : steps) EXPECT_LT((bodies[1] * center - center).norm(), 1e-12);
  EXPECT_TRUE(steps[14][1].isApprox(flexed(scene, radians(-30)).bodies[1], 1e-12));
  EXPECT_TRUE(steps.back()[1].isApprox(flexed(scene, radians(-60)).bodies[1], 0));
  EXPECT_EQ(pose_steps(steps[3], steps[3], radians(2), 0.005).size(), 1u);
}

TEST(PoseSteps, of_bodies_that_jump_by_kilometres_are_refused_and_can_be_stopped) {
  const std::vector<RigidTransform> near(2, RigidTransform::Identity());
  for (const Real jump : {1e4, 1e12, 1e300, std::numeric_limits<Real>::quiet_NaN()}) {
    std::vector<RigidTransform> away = near;
    away[1].translation().x() = jump;
    EXPECT_THROW(pose_steps(near, away, radians(2), 0.005), QualityError) << jump;
  }
  const std::atomic<bool> stop = true;
  const StopScope scope(&stop);
  EXPECT_THROW(pose_steps(near, near, radians(2), 0.005), Interrupted);
}

}  // namespace gracilis
