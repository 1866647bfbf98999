#include "scenario_runs.hpp"

#include <fstream>
#include <sstream>

/// The shared leg and elbow through the whole ranges of their joints, contact on: every muscle keeps every gate in
/// every frame.
namespace gracilis {
namespace {

struct Range {
  std::string name, scene, coordinates, key_poses_deg;
  std::string step_deg = "2";
};

std::string name_of_range(const testing::TestParamInfo<Range>& info) { return info.param.name; }

/// A copy of a scene's file with another motion. A scene is read with its motion: attachments
/// depend on it.
std::filesystem::path with_motion(const std::filesystem::path& scene, const Range& range) {
  std::stringstream text;
  text << std::ifstream(scene).rdbuf();
  const std::string all = text.str();
  const std::filesystem::path copy =
      std::filesystem::path(testing::TempDir()) / ("gracilis_limb_ranges_" + range.name + ".toml");
  std::ofstream(copy) << all.substr(0, all.find("[motion]")) << "[motion]\ncoordinates = " << range.coordinates
                      << "\nkey_poses_deg = " << range.key_poses_deg << "\nstep_deg = " << range.step_deg << "\n";
  return copy;
}

class LimbRanges : public testing::TestWithParam<Range> {};

TEST_P(LimbRanges, no_muscle_misses_a_gate_in_any_frame) {
  const std::filesystem::path file = data_folder() / GetParam().scene;
  if (data_folder().empty() || !std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here";
  SceneOptions options;
  options.data = file.parent_path();
  const Scene scene = read_scene(with_motion(file, GetParam()), options).scene;
  run_whole(scene, 1, [&](const FrameRecord& record) { expect_no_gate_missed(scene, record); });
}

static const std::string hip_and_knee = R"(["hip_flexion_r", "knee_flexion_r"])", elbow = R"(["elbow_flexion"])";

INSTANTIATE_TEST_SUITE_P(Long, LimbRanges,
                         testing::Values(Range{"hip", "leg/leg.toml", hip_and_knee, "[[0, 0], [-10, 0], [90, 0]]"},
                                         Range{"knee", "leg/leg.toml", hip_and_knee, "[[0, 0], [0, 110]]"},
                                         Range{"hip_and_knee", "leg/leg.toml", hip_and_knee, "[[0, 0], [90, 110]]"},
                                         Range{"elbow", "elbow/elbow.toml", elbow, "[[14], [0], [130]]"},
                                         Range{"elbow_slowly", "elbow/elbow.toml", elbow, "[[14], [0], [130]]", "1"},
                                         Range{"elbow_fast", "elbow/elbow.toml", elbow, "[[14], [0], [130]]", "3"},
                                         Range{"elbow_to_150", "elbow/elbow.toml", elbow, "[[14], [150]]"}),
                         name_of_range);

}  // namespace
}  // namespace gracilis
