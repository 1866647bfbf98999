#include "motion_facts.hpp"

/// The prepared hip to its limits in small, ordinary and large steps, every second frame judged.
namespace gracilis {

static HipMotion to_the_limit(const std::string& name, const std::string& file, bool may_fold) {
  HipMotion motion{.name = name, .folder = "lhdl_hip_prepared", .file = file};
  motion.judge_every = 2;
  motion.steps = {0.25, 1, 5};
  motion.may_fold = may_fold;
  return motion;
}

/// Where the thigh crushes a muscle against the pelvis it crumples: at 1 degree per frame iliacus cuts itself in 61
/// pairs of its 7,600 faces beyond 105 degrees of flexion, and gluteus maximus has 11 edges, at its attachment, in the
/// pelvis beyond 45 degrees of outward rotation. None explodes, and nothing enters another muscle.
static HipMotion crushing(HipMotion motion, Index own_cuts, Index bone_cuts) {
  motion.own_cuts = own_cuts;
  motion.bone_cuts = bone_cuts;
  return motion;
}

INSTANTIATE_TEST_SUITE_P(Long, HipInMotion,
                         testing::Values(crushing(to_the_limit("flexion_120", "flexion_limit", true), 80, 0),
                                         to_the_limit("extension_40", "extension_limit", false),
                                         to_the_limit("abduction_50", "abduction_limit", false),
                                         to_the_limit("adduction_30", "adduction", true),
                                         to_the_limit("rotation_inward_60", "rotation", true),
                                         crushing(to_the_limit("rotation_outward_60", "rotation_outward", true), 20,
                                                  15)),
                         motion_name);

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

}  // namespace gracilis
