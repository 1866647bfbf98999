#pragma once

#include <contact_check/gates.hpp>

#include "scenario_runs.hpp"

#include <map>
#include <string>

namespace gracilis {

/// A whole run with the verdict of the independent judge (tests/contact_check) on some or all of its frames.
struct JudgedRun {
  Scene scene;
  WholeRun whole;
  contact_check::FrameVerdict rest;
  contact_check::Verdict worst;  ///< by contact_check::Measure
  int judged_frames = 0;
  std::vector<MuscleShape> end;  ///< of the last frame
};

inline contact_check::Judge judge_of(const Scene& scene) {
  std::vector<contact_check::JudgedMuscle> muscles;
  std::vector<contact_check::JudgedBone> bones;
  for (const Muscle& muscle : scene.muscles) {
    muscles.push_back({muscle.name, muscle.surface, {}});
    muscles.back().attached.assign(static_cast<std::size_t>(muscle.surface.vertex_count()), 0);
    for (const Attachment& attachment : muscle.attachments)
      for (const Index vertex : attachment.vertices) muscles.back().attached[static_cast<std::size_t>(vertex)] = 1;
  }
  for (const Bone& bone : scene.bones) bones.push_back({bone.name, bone.surface});
  return {std::move(muscles), std::move(bones)};
}

/// Runs a scene and judges every so many frames, and the last.
inline JudgedRun run_judged(const Scene& scene, int judge_every, const contact_check::Gates& gates = {}) {
  JudgedRun run;
  run.scene = scene;
  const contact_check::Judge judge = judge_of(scene);
  const int last = static_cast<int>(pose_sequence(scene).size()) - 1;
  run.whole = run_whole(scene, 1, [&](const FrameRecord& record) {
    const int frame = record.frame.number;
    if (frame == last) run.end = record.frame.muscles;
    if (frame % judge_every != 0 && frame != last) return;
    std::vector<Points> muscles, bones;
    for (const MuscleShape& muscle : record.frame.muscles) muscles.push_back(muscle.points);
    for (const Bone& bone : scene.bones)
      bones.push_back(record.frame.pose.bodies[static_cast<std::size_t>(bone.body)] * bone.surface.vertices);
    const contact_check::FrameVerdict verdict = judge.judge(frame, muscles, bones);
    if (frame == 0) run.rest = verdict;
    keep_worst(hold_against(gates, judge, verdict), run.worst);
    ++run.judged_frames;
  });
  return run;
}

}  // namespace gracilis
