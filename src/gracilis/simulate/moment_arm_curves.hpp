#pragma once

#include <gracilis/methods/method.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/simulate/fiber_tracker.hpp>

#include <atomic>
#include <functional>
#include <string>
#include <vector>

namespace gracilis {

/// Makes the scene's motion one through a range: muscles settle in its first pose before it begins, for what they do
/// when they become active is no moment arm, and it ends where the range does.
void set_range(Scene& scene, Motion range);

/// Moment arms of all muscles that have fibers, along the scene's motion. A row is a row of the motion.
struct MomentArmCurves {
  std::vector<std::string> muscles;
  Eigen::VectorXd values;   ///< of the coordinate, rad (m)
  Eigen::MatrixXd lengths;  ///< rows × muscles: mean fiber length, m
  /// rows × muscles, m (of a translation m per m): those that the method knows, or else those that lengths say.
  Eigen::MatrixXd arms;
};

/// Runs a scene whose motion was made by set_range, and tells the arms about one of its coordinates, by its number in
/// coordinate_names. Throws QualityError as run_scene does, Interrupted soon after `stop` is set, and
/// ConfigurationError where there are more than `max_frames` frames. `look`, where it is not empty, sees the frame of
/// every row, one after the other. Precondition: `method` and `tracker` were made for the scene.
MomentArmCurves moment_arm_curves(const Scene& scene, Index coordinate, DeformationMethod& method,
                                  const FiberTracker& tracker, int max_frames, const std::atomic<bool>& stop,
                                  const std::function<void(Index row, const Frame&)>& look = {});

}  // namespace gracilis
