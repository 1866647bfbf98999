#include "scenario_runs.hpp"

/// Gluteus maximus of the real hip alone; all muscles together are in hip_motions_test.cpp.
namespace gracilis {

TEST(CadaverHip, gluteus_maximus_survives_120_degrees_of_flexion) {
  SKIP_WITHOUT_DATA();
  const Scene scene = cadaver_scene("flexion_120", {"gluteus_maximus_r"}, {"skinning=strings"});
  const WholeRun run = run_whole(scene);
  EXPECT_GT(run.frames, 120);
  expect_gates(scene, run);
}

}  // namespace gracilis
