#include <gracilis/io/scene/data_root.hpp>

#include "app/program.hpp"
#include "build_paths.hpp"
#include "io/scene_folder.hpp"

#include <gtest/gtest.h>

/// As somebody does who has a folder of surfaces: the scene is made, and runs.
namespace gracilis {

TEST(LegFromFolder, keeps_every_gate_while_hip_and_knee_bend) {
  const std::filesystem::path some_scene = std::filesystem::path(build_paths::source_folder) / "scenes" / "a.toml";
  const std::filesystem::path leg = find_data_root(some_scene, {}) / "leg";
  if (!std::filesystem::exists(leg)) GTEST_SKIP() << "the shared leg is not here: set GRACILIS_DATA";
  const SceneFolder folder;
  setenv("XDG_CACHE_HOME", folder.path("cache").c_str(), 1);
  const std::string scene = folder.path("leg.toml").string(), out = folder.path("run").string();
  const ProgramResult made = run_program("scene " + leg.string() + " --prepare --out " + scene);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  struct Bend {
    std::string key_poses_deg, step_deg;
  };
  for (const Bend& bend : {Bend{"[[0,0],[90,110]]", "4"}, Bend{"[[0,0],[0,110]]", "4"}, Bend{"[[0,0],[90,0]]", "4"},
                           Bend{"[[0,0],[60,90]]", "3"}}) {
    const ProgramResult run =
        run_program("run " + scene + " --strict --force --no-fibers --no-pictures --set \"motion.key_poses_deg=" +
                    bend.key_poses_deg + "\" --set motion.step_deg=" + bend.step_deg + " --out " + out);
    EXPECT_EQ(run.exit_code, 0) << bend.key_poses_deg << ": " << run.err;
  }
}

}  // namespace gracilis
