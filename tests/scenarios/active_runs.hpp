#pragma once

#include <gracilis/scene/motion.hpp>

#include "scenarios/fiber_runs.hpp"

#include <gtest/gtest.h>

#include <string>

namespace gracilis {

/// One muscle of the cadaver hip on its way from the capture pose to flexion, adduction and rotation `to` (degrees), as
/// active as this all the way.
inline Scene active_scene(const std::string& muscle, const Vec3& to, Real activation) {
  Scene scene = cadaver_scene("flexion", {muscle});
  scene.sequence.return_to_capture = false;
  Eigen::MatrixXd keys = Eigen::MatrixXd::Zero(2, 3);
  keys.row(1) = to.transpose() * radians(1);
  scene.motion = motion_through({"hip_flexion_r", "hip_adduction_r", "hip_rotation_r"}, keys, radians(1), 1.0 / 60);
  scene.activation.signals = {{muscle, {0}, {activation}}};
  return scene;
}

inline FiberRun active_run(const std::string& muscle, const Vec3& to, Real activation, int fibers = 100,
                           int segments = 15) {
  Scene scene = active_scene(muscle, to, activation);
  scene.muscles[0].fibers.count = fibers;
  scene.muscles[0].fibers.segments = segments;
  return run_with_fibers(scene);
}

inline void expect_volume(const FiberRun& run) {
  for (const auto& frame : run.measures) EXPECT_NEAR(frame[0].volume_ratio, 1, 0.005);
}

}  // namespace gracilis
