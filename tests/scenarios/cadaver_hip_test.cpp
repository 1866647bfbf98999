#include "scenario_runs.hpp"

/// The real hip through its whole motions, every frame measured with exact distances (Measurer).
namespace gracilis {

TEST(CadaverHip, flexes_to_90_degrees_and_returns_to_its_lengths) {
  SKIP_WITHOUT_DATA();
  const Scene scene = cadaver_scene("flexion");
  ASSERT_EQ(scene.muscles.size(), 5u);
  const WholeRun run = run_whole(scene);
  EXPECT_GT(run.frames, 180);
  expect_gates(scene, run);
  expect_return(scene, run);
}

TEST(CadaverHip, extends_to_30_degrees) {
  SKIP_WITHOUT_DATA();
  const Scene scene = cadaver_scene("extension");
  const WholeRun run = run_whole(scene);
  EXPECT_GT(run.frames, 30);
  expect_gates(scene, run);
}

TEST(CadaverHip, abducts_to_45_degrees) {
  SKIP_WITHOUT_DATA();
  const Scene scene = cadaver_scene("abduction");
  const WholeRun run = run_whole(scene);
  EXPECT_GT(run.frames, 45);
  expect_gates(scene, run);
}

TEST(CadaverHip, turns_inwards_by_60_degrees) {
  SKIP_WITHOUT_DATA();
  const Scene scene = cadaver_scene("rotation");
  const WholeRun run = run_whole(scene);
  EXPECT_GT(run.frames, 60);
  expect_gates(scene, run);
}

TEST(CadaverHip, gluteus_maximus_survives_120_degrees_of_flexion) {
  SKIP_WITHOUT_DATA();
  const Scene scene = cadaver_scene("flexion_120", {"gluteus_maximus_r"});
  const WholeRun run = run_whole(scene);
  EXPECT_GT(run.frames, 120);
  expect_gates(scene, run);
}

}  // namespace gracilis
