#include <gracilis/io/scene/data_root.hpp>

#include "app/program.hpp"
#include "build_paths.hpp"
#include "io/scene_folder.hpp"

#include <gtest/gtest.h>

/// As somebody does who has a folder of surfaces: the scene is made, and runs.
namespace gracilis {
namespace {

struct Bend {
  std::string name, key_poses_deg, step_deg;
};

class LegFromFolder : public testing::TestWithParam<Bend> {};

TEST_P(LegFromFolder, keeps_every_gate) {
  const std::filesystem::path some_scene = std::filesystem::path(build_paths::source_folder) / "scenes" / "a.toml";
  const std::filesystem::path leg = find_data_root(some_scene, {}) / "leg";
  if (!std::filesystem::exists(leg)) GTEST_SKIP() << "the shared leg is not here: set GRACILIS_DATA";
  const SceneFolder folder;
  setenv("XDG_CACHE_HOME", folder.path("cache").c_str(), 1);
  const std::string scene = folder.path("leg.toml").string(), out = folder.path("run").string();
  const ProgramResult made = run_program("scene " + leg.string() + " --prepare --out " + scene);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const ProgramResult run = run_program(
      "run " + scene + " --strict --no-fibers --no-pictures --set \"motion.key_poses_deg=" + GetParam().key_poses_deg +
      "\" --set motion.step_deg=" + GetParam().step_deg + " --out " + out);
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

std::string name_of_bend(const testing::TestParamInfo<Bend>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Long, LegFromFolder,
                         testing::Values(Bend{"hip_and_knee", "[[0,0],[90,110]]", "4"},
                                         Bend{"knee", "[[0,0],[0,110]]", "4"}, Bend{"hip", "[[0,0],[90,0]]", "4"},
                                         Bend{"both_less", "[[0,0],[60,90]]", "3"}),
                         name_of_bend);

}  // namespace
}  // namespace gracilis
