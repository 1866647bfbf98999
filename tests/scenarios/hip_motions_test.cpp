#include "motion_facts.hpp"

/// The motions of both hips by one degree per frame; every frame measured with exact distances, every eighth judged.
namespace gracilis {

static HipMotion prepared(const std::string& file, int judge_every, bool may_fold) {
  HipMotion motion{.name = "prepared_" + file, .folder = "lhdl_hip_prepared", .file = file};
  motion.judge_every = judge_every;
  motion.may_fold = may_fold;
  return motion;
}

/// As scanned, some triangles are needles of 0.05 mm and some lie folded on their neighbors.
static HipMotion as_scanned(const std::string& file, int judge_every, bool may_fold) {
  HipMotion motion{.name = "cadaver_" + file, .file = file};
  motion.judge_every = judge_every;
  motion.may_fold = may_fold;
  return motion;
}

INSTANTIATE_TEST_SUITE_P(
    Default, HipInMotion,
    testing::Values(HipMotion{.name = "builtin_flexion", .end = {90, 0, 0}, .judge_every = 5},
                    HipMotion{.name = "builtin_extension", .end = {-30, 0, 0}, .judge_every = 5, .may_fold = false},
                    HipMotion{.name = "builtin_abduction", .end = {0, -45, 0}, .judge_every = 5, .may_fold = false},
                    HipMotion{.name = "builtin_rotation", .end = {0, 0, 60}, .judge_every = 5},
                    as_scanned("flexion", 8, true), as_scanned("extension", 4, false),
                    as_scanned("abduction", 5, false), as_scanned("rotation", 6, true), prepared("flexion", 8, true),
                    prepared("extension", 4, false), prepared("abduction", 5, false), prepared("rotation", 6, true)),
    motion_name);

/// Contact is what keeps muscles out of each other: the facts above are false without it.
static void expect_muscles_to_sink_in(const HipMotion& motion) {
  const JudgedRun run = run_judged(scene_of(motion, 2, "none"), 5);
  ASSERT_FALSE(run.worst.empty());
  EXPECT_TRUE(run.worst[contact_check::face_pairs].missed);
  EXPECT_TRUE(run.worst[contact_check::deep_share].missed);
  EXPECT_TRUE(run.worst[contact_check::depth].missed);
}

TEST(HipWithoutContact, muscles_of_the_builtin_hip_sink_into_each_other) {
  expect_muscles_to_sink_in({.name = "builtin", .end = {90, 0, 0}});
}

TEST(HipWithoutContact, muscles_of_the_cadaver_hip_sink_into_each_other) {
  SKIP_WITHOUT_DATA();
  expect_muscles_to_sink_in({.name = "cadaver", .file = "extension"});
}

}  // namespace gracilis
