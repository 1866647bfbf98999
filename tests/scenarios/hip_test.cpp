#include <gracilis/anatomy/builtin_hip.hpp>

#include "scenario_runs.hpp"

/// The built-in hip, which needs no file, and a coarse look at the real one; its whole motions are in
/// cadaver_hip_test.cpp.
namespace gracilis {

TEST(CadaverHipScenario, adductor_brevis_survives_flexion_in_steps_of_five_degrees) {
  SKIP_WITHOUT_DATA();
  const Scene scene = cadaver_scene("flexion", {"adductor_brevis_r"});
  const WholeRun run = run_whole(scene, 5);
  EXPECT_GT(run.frames, 35);
  expect_gates(scene, run);
}

}  // namespace gracilis
