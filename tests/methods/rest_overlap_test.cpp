#include <contact_check/judge.hpp>
#include <gracilis/core/state_hash.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace gracilis {
namespace {

/// The tube with a second one that `motion` took from the same place.
Scene two_tubes(const RigidTransform& motion) {
  Scene scene = tube_scene();
  scene.muscles.push_back(scene.muscles.front());
  scene.muscles.back().name = "other";
  scene.muscles.back().surface.vertices = motion * scene.muscles.back().surface.vertices;
  return scene;
}

/// Turned by `angle` about the line through the middle that leads from the bones, and moved along that by `away`.
Scene crossing_tubes(Real angle, Real away) {
  const Vec3 middle(0.0255, 0, 0);
  return two_tubes(Eigen::Translation3d(middle + Vec3(away, 0, 0)) * Eigen::AngleAxisd(angle, Vec3::UnitX()) *
                   Eigen::Translation3d(-middle));
}

struct Overlap {
  Index face_pairs = 0;
  Real depth = 0;         ///< m
  Real beyond_rest = 0;   ///< m, of a vertex
  Real longest_step = 0;  ///< m, of a vertex since the frame before
};

/// What an independent program says about frames 0 to `frames` of a slow flexion to `angle`.
std::vector<Overlap> overlaps_of(const Scene& scene, int frames, Real angle) {
  std::vector<contact_check::JudgedMuscle> judged;
  for (const Muscle& muscle : scene.muscles)
    judged.push_back(
        {muscle.name, muscle.surface, std::vector<char>(static_cast<std::size_t>(muscle.surface.vertex_count()), 0)});
  const contact_check::Judge judge(judged, {});
  const auto method = xpbd_on_tube(scene);
  Frame before = frame_of(*method, flexed(scene, 0), 0);
  std::vector<Overlap> overlaps;
  for (int number = 0; number <= frames; ++number) {
    const Pose pose = flexed(scene, angle * number / frames);
    if (number > 0) method->advance(pose, usual_time_step);
    const Frame now = frame_of(*method, pose, number);
    const contact_check::FrameVerdict verdict = judge.judge(number, {now.muscles[0].points, now.muscles[1].points}, {});
    EXPECT_TRUE(verdict.finite);
    overlaps.push_back({verdict.pairs[0].face_pairs, verdict.pairs[0].depth, verdict.pairs[0].depth_beyond_rest,
                        farthest(now, before)});
    before = now;
  }
  return overlaps;
}

void expect_gradual_release(const std::vector<Overlap>& overlaps, Real longest_step) {
  ASSERT_GT(overlaps[0].face_pairs, 20);
  for (std::size_t frame = 1; frame < overlaps.size(); ++frame) {
    EXPECT_LE(overlaps[frame].face_pairs, overlaps[0].face_pairs) << frame;
    EXPECT_LE(overlaps[frame].depth, overlaps[0].depth + 1e-5) << frame;
    EXPECT_LT(overlaps[frame].longest_step, longest_step) << frame;
  }
  EXPECT_LE(2 * overlaps.back().face_pairs, overlaps[0].face_pairs);
}

}  // namespace

TEST(RestOverlap, of_crossing_tubes_never_grows_halves_within_30_frames_and_jumps_nowhere) {
  const std::vector<Overlap> overlaps = overlaps_of(crossing_tubes(radians(40), 0.014), 30, 0);
  expect_gradual_release(overlaps, 0.001);
  EXPECT_LE(2 * overlaps.back().depth, overlaps[0].depth);
}

TEST(RestOverlap, of_tubes_side_by_side_is_released_but_where_attachments_overlap) {
  const std::vector<Overlap> overlaps =
      overlaps_of(two_tubes(RigidTransform(Eigen::Translation3d(0, 0.016, 0))), 30, 0);
  expect_gradual_release(overlaps, 0.001);
  EXPECT_NEAR(overlaps.back().depth, overlaps[0].depth, 1e-5) << "attached vertices stay where they are";
}

TEST(RestOverlap, is_released_while_the_joint_bends) {
  // The lower ends swing by 140 mm times the angle in each frame.
  expect_gradual_release(overlaps_of(crossing_tubes(radians(40), 0.014), 30, radians(20)),
                         0.001 + 0.14 * radians(20) / 30);
}

TEST(RestOverlap, a_tube_through_another_stays_as_deep_as_it_is_however_the_joint_bends) {
  const auto deepest_beyond_rest = [](const Scene& scene) {
    Real deepest = 0;
    for (const Overlap& overlap : overlaps_of(scene, 30, radians(60))) deepest = std::max(deepest, overlap.beyond_rest);
    return deepest;
  };
  for (const Real away : {0.0, 0.004}) {
    Scene scene = crossing_tubes(radians(90), away);
    EXPECT_LT(deepest_beyond_rest(scene), 0.0005) << away;
    scene.method.contact["muscle"] = "none";
    EXPECT_GT(deepest_beyond_rest(scene), 0.002) << "without contact, " << away;
  }
}

TEST(RestOverlap, goes_on_being_released_in_a_resumed_run_to_the_same_bits) {
  const Scene scene = crossing_tubes(radians(40), 0.014);
  const auto whole = xpbd_on_tube(scene), resumed = xpbd_on_tube(scene);
  std::vector<Frame> frames;
  for (int number = 1; number <= 8; ++number) {
    whole->advance(flexed(scene, 0), usual_time_step);
    frames.push_back(frame_of(*whole, flexed(scene, 0), number));
  }
  resumed->restore(std::vector<Pose>(6, flexed(scene, 0)), frames[3], frames[4]);
  for (int number = 6; number <= 8; ++number) resumed->advance(flexed(scene, 0), usual_time_step);
  EXPECT_EQ(farthest(frame_of(*resumed, flexed(scene, 0), 8), frames[7]), 0);
}

}  // namespace gracilis
