#include "scenarios/judged_run.hpp"

#include <gtest/gtest.h>

namespace gracilis {

static void expect_every_bar_held(const Scene& scene) {
  ASSERT_EQ(scene.muscles.size(), 5u);
  Real most = 0;
  for (const Pose& pose : pose_sequence(scene))
    for (const Real activation : pose.activations) most = std::max(most, activation);
  EXPECT_GT(most, 0.2) << "no muscle was ever active";
  const JudgedRun run = run_judged(scene, 3);
  ASSERT_GT(run.judged_frames, 40);
  ASSERT_FALSE(run.worst.empty());
  for (std::size_t i = 0; i < run.worst.size(); ++i)
    EXPECT_FALSE(run.worst[i].missed) << contact_check::measure_names()[i] << ": " << run.worst[i].value << " in frame "
                                      << run.worst[i].frame << ", " << run.worst[i].where;
  expect_gates(run.scene, run.whole);
}

TEST(Gait, drives_five_muscles_through_a_cycle_with_every_bar_held) {
  SKIP_WITHOUT_DATA();
  expect_every_bar_held(cadaver_scene("gait"));
}

TEST(Gait, drives_the_prepared_muscles_through_it_with_every_bar_held) {
  SKIP_WITHOUT_DATA();
#ifndef GRACILIS_WITH_PREPARE
  GTEST_SKIP() << "built without GRACILIS_WITH_PREPARE";
#endif
  expect_every_bar_held(cadaver_scene("../lhdl_hip_prepared/gait"));
}

}  // namespace gracilis
