#include <gracilis/simulate/measures.hpp>

#include <scenes_for_tests.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gracilis {
namespace {

/// Flexes the tube to a right angle, degree by degree, and holds it there.
struct Held {
  Scene scene;
  std::vector<MuscleMeasures> measures;  ///< of every frame
  Index contacts = 0;                    ///< summed over all frames
};

Held held_at_a_right_angle(const XpbdSettings& settings) {
  Held held{tube_scene(settings), {}, 0};
  Measurer measurer(held.scene);
  const auto method = xpbd_on_tube(held.scene);
  for (int frame = 1; frame <= 120; ++frame) {
    const Pose pose = flexed(held.scene, radians(std::min(frame, 90)));
    held.contacts += static_cast<Index>(metric(method->advance(pose, usual_time_step).muscles[0].metrics, "contacts"));
    held.measures.push_back(measurer.measure(frame_of(*method, pose, frame)).at(0));
  }
  return held;
}

}  // namespace

TEST(Xpbd, a_muscle_held_at_a_right_angle_keeps_its_volume_and_stays_out_of_the_bones) {
  // Without slack uptake the tube is pulled tight over the bones; with it, it keeps to its arc around them.
  for (const bool slack_uptake : {false, true}) {
    SCOPED_TRACE(slack_uptake ? "with slack uptake" : "without slack uptake");
    XpbdSettings settings;
    settings.slack_uptake = slack_uptake;
    const Held held = held_at_a_right_angle(settings);
    for (std::size_t frame = 0; frame < held.measures.size(); ++frame) {
      EXPECT_NEAR(held.measures[frame].volume_ratio, 1, 0.005) << "frame " << frame + 1;
      EXPECT_LE(held.measures[frame].vertex_depth, 1e-4) << "frame " << frame + 1;
      EXPECT_LE(held.measures[frame].midpoint_depth_beyond_rest, 5e-4) << "frame " << frame + 1;
      EXPECT_TRUE(held.measures[frame].finite);
    }
    EXPECT_GT(held.measures.back().edge_ratio_mean, 1.05) << "the muscle was never stretched";
    if (!slack_uptake) {
      EXPECT_GT(held.contacts, 0) << "the muscle never met a bone";
    }
  }
}

TEST(Xpbd, returns_to_its_lengths_when_the_joint_returns) {
  const Scene scene = tube_scene();
  Measurer measurer(scene);
  const auto method = xpbd_on_tube(scene);
  for (int degree = 1; degree <= 90; ++degree) method->advance(flexed(scene, radians(degree)), usual_time_step);
  for (int degree = 89; degree >= 0; --degree) method->advance(flexed(scene, radians(degree)), usual_time_step);
  const MuscleMeasures end = measurer.measure(frame_of(*method, flexed(scene, 0), 0)).at(0);
  EXPECT_NEAR(end.edge_ratio_mean, 1, 0.005);
}

TEST(Xpbd, stops_a_frame_early_when_nothing_moves) {
  XpbdSettings settings;
  settings.stop_displacement = 1e-5;
  const Scene scene = tube_scene(settings);
  const auto method = xpbd_on_tube(scene);
  EXPECT_LT(metric(method->advance(flexed(scene, 0), usual_time_step).muscles[0].metrics, "iterations"), 3);
}

TEST(Xpbd, in_dynamic_mode_gravity_pulls_and_attachments_hold) {
  XpbdSettings settings;
  settings.time_mode = TimeMode::dynamic;
  settings.gravity = Vec3(9.81, 0, 0);
  const Scene scene = tube_scene(settings);
  const auto method = xpbd_on_tube(scene);
  for (int i = 0; i < 60; ++i) method->advance(flexed(scene, 0), usual_time_step);
  const Frame frame = frame_of(*method, flexed(scene, 0), 0);
  const Points& rest = scene.muscles[0].surface.vertices;
  Real sag = 0;
  for (Index v = 0; v < rest.cols(); ++v)
    if (std::abs(rest(2, v)) < 0.01) sag = std::max(sag, frame.muscles[0].points(0, v) - rest(0, v));
  EXPECT_GT(sag, 1e-4);
  for (Index v : scene.muscles[0].attachments[0].vertices)
    EXPECT_LT((frame.muscles[0].points.col(v) - rest.col(v)).norm(), 1e-8);
}

TEST(Xpbd, a_muscle_told_to_slide_on_a_bone_does_not_lift_off) {
  const auto farthest_from_the_bone = [](const XpbdSettings& settings) {
    const Scene scene = tube_scene(settings);
    const auto method = xpbd_on_tube(scene);
    // The lower bone turns forwards and takes the muscle away from the upper.
    for (int degree = 1; degree <= 30; ++degree) method->advance(flexed(scene, radians(degree)), usual_time_step);
    const Frame frame = frame_of(*method, flexed(scene, radians(30)), 30);
    Real farthest = 0;
    for (Index v = 0; v < scene.muscles[0].surface.vertex_count(); ++v) {
      const Eigen::Vector3f rest = scene.muscles[0].surface.vertices.col(v).cast<float>();
      const Eigen::Vector3f now = frame.muscles[0].points.col(v).cast<float>();
      const float before = sample(tube_fields()[0], rest).distance;
      if (before > 0.0015f || rest.z() > 0.07f) continue;
      farthest = std::max(farthest, static_cast<Real>(sample(tube_fields()[0], now).distance - before));
    }
    return farthest;
  };
  XpbdSettings settings;
  EXPECT_GT(farthest_from_the_bone(settings), 1e-3) << "it never lifted off";
  settings.slide_on_bone = "upper";
  settings.slide_reach = 0.0015;
  EXPECT_LT(farthest_from_the_bone(settings), 2e-4);
}

}  // namespace gracilis
