#pragma once

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/simulate/fiber_tracker.hpp>

#include "scenario_runs.hpp"

#include <algorithm>

namespace gracilis {

/// Flexion and the fibers of all muscles, frame by frame.
struct FiberRun {
  std::vector<Real> flexion;                          ///< rad
  std::vector<std::vector<MuscleFibers>> frames;      ///< frames × muscles
  std::vector<std::vector<MuscleMeasures>> measures;  ///< frames × muscles
  std::vector<MuscleShape> end;                       ///< of the last frame

  std::vector<Real> means(std::size_t muscle, std::size_t first, std::size_t last) const {
    std::vector<Real> values;
    for (std::size_t i = first; i <= last; ++i) values.push_back(frames[i][muscle].mean_length);
    return values;
  }
};

/// `observe` sees every frame.
inline FiberRun run_with_fibers(const Scene& scene, const std::function<void(const FrameRecord&)>& observe = {}) {
  const auto method = make_xpbd_method(scene, cached_bone_fields(scene));
  const FiberTracker tracker(scene);
  const std::vector<std::string> names = coordinate_names(scene);
  const auto flexion = static_cast<std::size_t>(std::find(names.begin(), names.end(), "hip_flexion_r") - names.begin());
  FiberRun run;
  const std::atomic<bool> never = false;
  run_scene(
      scene, pose_sequence(scene), *method, nullptr, never,
      [&](const FrameRecord& record) {
        run.flexion.push_back(record.frame.pose.coordinates[flexion]);
        run.frames.push_back(record.fibers);
        run.measures.push_back(record.measures);
        run.end = record.frame.muscles;
        if (observe) observe(record);
      },
      &tracker);
  return run;
}

inline std::size_t muscle_of(const Scene& scene, const std::string& name) {
  for (std::size_t i = 0; i < scene.muscles.size(); ++i)
    if (scene.muscles[i].name == name) return i;
  ADD_FAILURE() << name;
  return 0;
}

}  // namespace gracilis
