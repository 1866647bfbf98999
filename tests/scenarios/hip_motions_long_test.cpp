#include "motion_facts.hpp"

/// The cadaver's hip to its limits in small, ordinary and large steps, every frame judged.
namespace gracilis {

static const std::vector<Real> all_steps = {0.25, 1, 5};

INSTANTIATE_TEST_SUITE_P(
    Long, HipInMotion,
    testing::Values(HipMotion{.name = "flexion_120", .file = "flexion_limit", .steps = all_steps},
                    HipMotion{.name = "extension_40", .file = "extension_limit", .steps = all_steps, .may_fold = false},
                    HipMotion{.name = "abduction_50", .file = "abduction_limit", .steps = all_steps, .may_fold = false},
                    HipMotion{.name = "adduction_30", .file = "adduction", .steps = all_steps},
                    HipMotion{.name = "rotation_inward_60", .file = "rotation", .steps = all_steps},
                    HipMotion{.name = "rotation_outward_60", .file = "rotation_outward", .steps = all_steps}),
    name_of);

TEST_P(HipInMotion, the_end_depends_little_on_the_size_of_the_steps) {
  const JudgedRun& reference = run(1);
  for (const Real step : GetParam().steps) {
    ASSERT_EQ(run(step).end.size(), reference.end.size());
    for (std::size_t m = 0; m < reference.end.size(); ++m) {
      const Real mean = (run(step).end[m].points - reference.end[m].points).colwise().norm().mean();
      EXPECT_LE(mean, 2e-3) << reference.scene.muscles[m].name << ", " << step << " against 1 degree per frame";
    }
  }
}

TEST_P(HipInMotion, the_whole_motion_is_judged_at_every_step) {
  for (const Real step : GetParam().steps) EXPECT_EQ(run(step).judged_frames, run(step).whole.frames);
  EXPECT_GT(run(0.25).whole.frames, 3 * run(1).whole.frames);
}

}  // namespace gracilis
