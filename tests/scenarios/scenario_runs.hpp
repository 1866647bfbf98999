#pragma once

#include <gracilis/anatomy/pose_sequence.hpp>
#include <gracilis/io/scene/data_root.hpp>
#include <gracilis/io/scene/field_cache.hpp>
#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/methods/xpbd/xpbd_method.hpp>

#include <build_paths.hpp>
#ifdef GRACILIS_WITH_PREPARE
#include <gracilis/prepare/prepare_surfaces.hpp>
#endif
#include <gracilis/simulate/run.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace gracilis {

inline std::filesystem::path scene_file(const std::string& name) {
  return std::filesystem::path(build_paths::source_folder) / "scenes" / "lhdl_hip" / (name + ".toml");
}

/// The folder with the cadaver's data, or empty: GRACILIS_DATA, else shared/data beside the checkout or above it.
inline std::filesystem::path data_folder() {
  const std::filesystem::path folder = find_data_root(scene_file("flexion"), {});
  return !folder.empty() && std::filesystem::is_directory(folder / "lhdl-hip") ? folder : std::filesystem::path();
}

#define SKIP_WITHOUT_DATA()  \
  if (data_folder().empty()) \
  GTEST_SKIP() << "the cadaver's data are not here: set GRACILIS_DATA, or put them into ../shared/data"

inline Scene cadaver_scene(const std::string& name, const std::vector<std::string>& only = {},
                           const std::vector<std::string>& set = {}) {
  SceneOptions options;
  options.data = data_folder();
  options.only = only;
  options.set = set;
#ifdef GRACILIS_WITH_PREPARE
  options.prepare = prepare_surfaces;
#endif
  return read_scene(scene_file(name), options).scene;
}

/// The worst of a muscle over a whole run, and its last frame.
struct MuscleRun {
  Real volume_error = 0, vertex_depth = 0, midpoint_depth = 0, muscle_depth = 0, free_edge_ratio = 0;
  Real belly_off_place = 0, wrong_side = 0, slack = 0;
  int volume_frame = 0, vertex_frame = 0, midpoint_frame = 0, muscle_depth_frame = 0, edge_frame = 0;
  int belly_frame = 0, side_frame = 0, slack_frame = 0;
  MuscleMeasures last;
};

struct WholeRun {
  int frames = 0;
  std::vector<MuscleRun> muscles;
};

inline void keep_worst(Real value, int frame, Real& worst, int& worst_frame) {
  if (value > worst) worst = value, worst_frame = frame;
}

/// Runs the whole motion; `stride` keeps every so many poses only, which makes larger steps of them. `observe` sees
/// every frame.
inline WholeRun run_whole(const Scene& scene, int stride = 1,
                          const std::function<void(const FrameRecord&)>& observe = {}) {
  std::vector<Pose> poses;
  const std::vector<Pose> all = pose_sequence(scene);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i % static_cast<std::size_t>(stride) == 0 || i + 1 == all.size()) poses.push_back(all[i]);
  const auto method = make_xpbd_method(scene, cached_bone_fields(scene));
  WholeRun run;
  run.muscles.resize(scene.muscles.size());
  const std::atomic<bool> never = false;
  const auto add = [&](const FrameRecord& record) {
    ++run.frames;
    if (observe) observe(record);
    for (std::size_t m = 0; m < run.muscles.size(); ++m) {
      MuscleRun& muscle = run.muscles[m];
      const MuscleMeasures& now = record.measures[m];
      const int frame = record.frame.number;
      ASSERT_TRUE(now.finite) << scene.muscles[m].name << ", frame " << frame;
      keep_worst(std::abs(now.volume_ratio - 1), frame, muscle.volume_error, muscle.volume_frame);
      keep_worst(now.vertex_depth_beyond_rest, frame, muscle.vertex_depth, muscle.vertex_frame);
      keep_worst(now.midpoint_depth_beyond_rest, frame, muscle.midpoint_depth, muscle.midpoint_frame);
      keep_worst(now.muscle_depth_beyond_rest, frame, muscle.muscle_depth, muscle.muscle_depth_frame);
      keep_worst(now.edge_ratio_max_free, frame, muscle.free_edge_ratio, muscle.edge_frame);
      keep_worst(now.belly_off_place, frame, muscle.belly_off_place, muscle.belly_frame);
      keep_worst(now.wrong_side, frame, muscle.wrong_side, muscle.side_frame);
      keep_worst(now.slack, frame, muscle.slack, muscle.slack_frame);
      muscle.last = now;
    }
  };
  EXPECT_EQ(run_scene(scene, poses, *method, nullptr, never, add), RunEnd::complete);
  EXPECT_EQ(run.frames, static_cast<int>(poses.size()));
  return run;
}

/// No muscle misses a gate in this frame.
inline void expect_no_gate_missed(const Scene& scene, const FrameRecord& record) {
  for (std::size_t m = 0; m < scene.muscles.size(); ++m)
    EXPECT_THAT(missed_gates(record.measures[m], {}), testing::IsEmpty())
        << scene.muscles[m].name << ", frame " << record.frame.number;
}

/// By the scene's own method no muscle misses a gate in any frame.
inline void expect_gates_kept(const Scene& scene) {
  const auto method =
      make_method(scene, [&](const DistanceFieldSettings& settings) { return cached_bone_fields(scene, settings); });
  const std::atomic<bool> never = false;
  const auto look = [&](const FrameRecord& record) { expect_no_gate_missed(scene, record); };
  EXPECT_EQ(run_scene(scene, pose_sequence(scene), *method, nullptr, never, look), RunEnd::complete);
}

/// What must hold in every frame of every scene.
inline void expect_gates(const Scene& scene, const WholeRun& run) {
  ASSERT_EQ(run.muscles.size(), scene.muscles.size());
  for (std::size_t m = 0; m < run.muscles.size(); ++m) {
    const MuscleRun& muscle = run.muscles[m];
    const std::string& name = scene.muscles[m].name;
    EXPECT_LE(muscle.volume_error, 0.005) << name << ", frame " << muscle.volume_frame;
    EXPECT_LE(muscle.vertex_depth, 1e-4) << name << ", frame " << muscle.vertex_frame;
    EXPECT_LE(muscle.midpoint_depth, 5e-4) << name << ", frame " << muscle.midpoint_frame;
    EXPECT_LE(muscle.muscle_depth, 1e-3) << name << ", frame " << muscle.muscle_depth_frame;
    EXPECT_LE(muscle.free_edge_ratio, 3) << name << ", frame " << muscle.edge_frame;
    // A muscle about a model's line goes where that line leads.
    if (scene.muscles[m].action_line.rays == 0) {
      EXPECT_LE(muscle.belly_off_place, 0.018) << name << ", frame " << muscle.belly_frame;
    }
    EXPECT_EQ(muscle.wrong_side, 0) << name << ", frame " << muscle.side_frame;
    EXPECT_LE(muscle.slack, 0.15) << name << ", frame " << muscle.slack_frame;
  }
}

/// What must hold after a motion that ends where it began.
inline void expect_return(const Scene& scene, const WholeRun& run) {
  for (std::size_t m = 0; m < run.muscles.size(); ++m)
    EXPECT_NEAR(run.muscles[m].last.edge_ratio_mean, 1, 0.005) << scene.muscles[m].name;
}

}  // namespace gracilis
