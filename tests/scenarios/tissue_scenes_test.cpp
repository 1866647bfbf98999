#include "scenario_runs.hpp"

namespace gracilis {
namespace {

/// A scene of the shared data by `tissue`: that no muscle misses a gate in any frame.
void expect_gates_kept(const std::string& name, const std::vector<std::string>& only, const std::string& key_poses,
                       const std::string& step) {
  const std::filesystem::path folder = data_folder() / name;
  if (data_folder().empty() || !std::filesystem::is_directory(folder)) GTEST_SKIP() << name << " is not here";
  SceneOptions options;
  options.data = folder;
  options.only = only;
  options.set = {"method=tissue", "motion.key_poses_deg=" + key_poses, "motion.step_deg=" + step};
  const Scene scene = read_scene(folder / (name + ".toml"), options).scene;
  const auto method = make_method(scene, [&](const DistanceFieldSettings&) { return cached_bone_fields(scene); });
  const std::atomic<bool> never = false;
  const auto look = [&](const FrameRecord& record) { expect_no_gate_missed(scene, record); };
  EXPECT_EQ(run_scene(scene, pose_sequence(scene), *method, nullptr, never, look), RunEnd::complete);
}

}  // namespace

TEST(TissueScenes, no_muscle_of_a_scanned_elbow_misses_a_gate) {
  expect_gates_kept("elbow", {}, "[[14],[0],[120]]", "5");
}

TEST(TissueScenes, tendons_at_the_patella_keep_every_gate_while_the_knee_bends) {
  expect_gates_kept("leg", {"rectus_femoris_r", "vastus_intermedius_r", "vastus_lateralis_r", "vastus_medialis_r"},
                    "[[0,0],[0,80]]", "5");
}

/// They share a tendon at the ischium, and their thin ends are pressed on each other there.
TEST(TissueScenes, biceps_and_semitendinosus_keep_every_gate_while_hip_and_knee_bend) {
  expect_gates_kept("leg", {"biceps_femoris_long_r", "semitendinosus_r"}, "[[0,0],[60,60]]", "4");
}

}  // namespace gracilis
