#include "scenario_runs.hpp"

namespace gracilis {
namespace {

std::vector<std::string> by_tissue(const std::string& key_poses, const std::string& step) {
  return {"method=tissue", "motion.key_poses_deg=" + key_poses, "motion.step_deg=" + step};
}

/// A scene of the shared data's folder of that name.
void expect_gates_kept(const std::string& name, const std::vector<std::string>& only, const std::string& key_poses,
                       const std::string& step) {
  const std::filesystem::path folder = data_folder() / name;
  if (data_folder().empty() || !std::filesystem::is_directory(folder)) GTEST_SKIP() << name << " is not here";
  SceneOptions options;
  options.data = folder;
  options.only = only;
  options.set = by_tissue(key_poses, step);
  expect_gates_kept(read_scene(folder / (name + ".toml"), options).scene);
}

}  // namespace

TEST(TissueScenes, no_muscle_of_a_scanned_elbow_misses_a_gate) {
  expect_gates_kept("elbow", {}, "[[14],[0],[120]]", "5");
}

TEST(TissueScenes, tendons_at_the_patella_keep_every_gate_while_the_knee_bends) {
  expect_gates_kept("leg", {"rectus_femoris_r", "vastus_intermedius_r", "vastus_lateralis_r", "vastus_medialis_r"},
                    "[[0,0],[0,80]]", "5");
}

/// Behind the pubis it folds, and has edges of a tenth of a millimeter.
TEST(TissueScenes, a_scanned_adductor_brevis_keeps_every_gate_in_extension) {
  SKIP_WITHOUT_DATA();
  expect_gates_kept(cadaver_scene("extension", {"adductor_brevis_r"}, by_tissue("[[0,0,0],[-30,0,0]]", "5")));
}

/// The hip presses it flat, at some 10 kPa.
TEST(TissueScenes, a_scanned_iliacus_keeps_its_volume_while_the_hip_flexes) {
  SKIP_WITHOUT_DATA();
  expect_gates_kept(cadaver_scene("flexion", {"iliacus_r"}, by_tissue("[[0,0,0],[90,0,0]]", "5")));
}

/// They share a tendon at the ischium, and their thin ends are pressed on each other there.
TEST(TissueScenes, biceps_and_semitendinosus_keep_every_gate_while_hip_and_knee_bend) {
  expect_gates_kept("leg", {"biceps_femoris_long_r", "semitendinosus_r"}, "[[0,0],[60,60]]", "4");
}

/// Where all three are pressed on the ischium single vertices look away from the muscle that they lie in.
TEST(TissueScenes, hamstrings_stay_out_of_each_other_where_hip_and_knee_are_flexed_far) {
  expect_gates_kept("leg", {"biceps_femoris_long_r", "semimembranosus_r", "semitendinosus_r"}, "[[0,0],[90,110]]", "5");
}

}  // namespace gracilis
