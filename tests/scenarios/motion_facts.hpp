#pragma once

#include <gracilis/io/scene/demo_scene.hpp>
#include <gracilis/scene/motion.hpp>

#include <fmt/format.h>

#include "judged_run.hpp"

#include <algorithm>
#include <ostream>
#include <vector>

/// What must hold in every motion of a hip, one fact each. The facts of one motion share its runs, so CTest starts one
/// process per motion (CMakeLists.txt).
namespace gracilis {

struct HipMotion {
  std::string name = {};
  std::string folder = "lhdl_hip";  ///< in scenes
  std::string file = {};            ///< there; empty for the built-in hip
  Vec3 end = Vec3::Zero();          ///< where the built-in hip goes to: flexion, adduction, rotation in degrees
  int judge_every = 1;              ///< frames
  std::vector<Real> steps = {1};    ///< degrees per frame, a run for each
  bool may_fold = true;             ///< fewer than a thousandth of all dihedrals; otherwise none
  Index own_cuts = 0;   ///< pairs of faces of one muscle, for needles in the data and crumples at the limits
  Index bone_cuts = 0;  ///< edges in a bone, for the same
};

inline void PrintTo(const HipMotion& motion, std::ostream* out) { *out << motion.name; }

inline std::string motion_name(const testing::TestParamInfo<HipMotion>& info) { return info.param.name; }

/// The motion with contact as the scene says ("") or as `contact` does.
inline Scene scene_of(const HipMotion& motion, Real step, const std::string& contact = "") {
  if (!motion.file.empty()) {
    // Six degrees lead from the capture pose into the motion.
    std::vector<std::string> set = {fmt::format("motion.step_deg={}", step),
                                    fmt::format("sequence.ramp_frames={}", std::ceil(6 / step))};
    if (!contact.empty()) set.push_back("contact.muscle=" + contact);
    return cadaver_scene("../" + motion.folder + "/" + motion.file, {}, set);
  }
  Scene scene = demo_scene("hip");
  Eigen::MatrixXd keys = Eigen::MatrixXd::Zero(2, 3);
  keys.row(1) = motion.end.transpose() * (pi / 180);
  scene.motion = motion_through({"hip_flexion_r", "hip_adduction_r", "hip_rotation_r"}, keys, radians(step), 1.0 / 60);
  if (contact == "none") scene.method.contact["muscle"] = "none";
  return scene;
}

class HipInMotion : public testing::TestWithParam<HipMotion> {
 protected:
  void SetUp() override {
    if (!GetParam().file.empty()) {
      SKIP_WITHOUT_DATA();
#ifndef GRACILIS_WITH_PREPARE
      if (GetParam().folder == "lhdl_hip_prepared") GTEST_SKIP() << "built without GRACILIS_WITH_PREPARE";
#endif
    }
    for (const Real step : GetParam().steps) run(step);
  }

  /// The motion's run at that many degrees per frame, made once.
  static const JudgedRun& run(Real step) {
    static std::map<std::pair<std::string, Real>, JudgedRun> runs;
    const HipMotion& motion = GetParam();
    const auto [found, fresh] = runs.try_emplace({motion.name, step});
    if (fresh) {
      contact_check::Gates gates;
      if (!motion.may_fold) gates.folded_share = 0;
      gates.self_pairs = motion.own_cuts;
      gates.bone_edges = motion.bone_cuts;
      // Large steps make few frames, which are judged one by one.
      found->second = run_judged(scene_of(motion, step), step > 2 ? 1 : motion.judge_every, gates);
    }
    return found->second;
  }

  static void expect_held(contact_check::Measure measure) {
    for (const Real step : GetParam().steps) {
      ASSERT_FALSE(run(step).worst.empty());
      ASSERT_GT(run(step).judged_frames, 5);
      const contact_check::Worst& worst = run(step).worst[measure];
      EXPECT_FALSE(worst.missed) << contact_check::measure_names()[measure] << ": " << worst.value << " in frame "
                                 << worst.frame << ", " << worst.where << ", at " << step << " degrees per frame";
    }
  }
};

TEST_P(HipInMotion, muscles_cut_each_other_no_more_than_at_rest) { expect_held(contact_check::face_pairs); }

TEST_P(HipInMotion, no_muscle_cuts_itself) { expect_held(contact_check::self_pairs); }

TEST_P(HipInMotion, fewer_than_one_in_a_thousand_vertices_are_inside_another_muscle) {
  expect_held(contact_check::deep_share);
}

TEST_P(HipInMotion, no_vertex_is_a_millimeter_inside_another_muscle) { expect_held(contact_check::depth); }

TEST_P(HipInMotion, overlap_at_rest_does_not_deepen) { expect_held(contact_check::growth); }

TEST_P(HipInMotion, no_edge_crosses_a_bone) { expect_held(contact_check::bone_edges); }

TEST_P(HipInMotion, dihedrals_do_not_fold) { expect_held(contact_check::folded_share); }

TEST_P(HipInMotion, volume_is_kept) { expect_held(contact_check::volume_error); }

TEST_P(HipInMotion, no_muscle_cuts_itself_at_rest) {
  for (const Real step : GetParam().steps)
    for (const contact_check::MuscleVerdict& muscle : run(step).rest.muscles) EXPECT_EQ(muscle.self_pairs, 0);
}

TEST_P(HipInMotion, muscles_overlap_at_rest_as_they_were_scanned_and_nowhere_else) {
  const bool as_scanned = !GetParam().file.empty() && GetParam().folder == "lhdl_hip";
  for (const Real step : GetParam().steps) {
    const std::vector<contact_check::PairVerdict>& pairs = run(step).rest.pairs;
    const auto overlapping = std::count_if(pairs.begin(), pairs.end(), [](const contact_check::PairVerdict& pair) {
      return pair.face_pairs > 0 || pair.depth > 0;
    });
    EXPECT_EQ(overlapping > 0, as_scanned) << overlapping << " pairs of muscles";
  }
}

TEST_P(HipInMotion, every_frame_meets_the_gates_of_a_run) {
  for (const Real step : GetParam().steps) {
    SCOPED_TRACE(fmt::format("{} degrees per frame", step));
    expect_gates(run(step).scene, run(step).whole);
    if (run(step).scene.sequence.return_to_capture) expect_return(run(step).scene, run(step).whole);
  }
}

}  // namespace gracilis
