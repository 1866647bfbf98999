#pragma once

#include <gracilis/calibrate/calibration.hpp>
#include <gracilis/io/scene/scene_reader.hpp>

#include <atomic>

namespace gracilis {

/// A way through poses that the scene is taken; targets of the same coordinate and pose share one.
struct TargetSweep {
  std::string coordinate;            ///< that moves; empty: one pose
  std::map<std::string, Real> pose;  ///< as in CalibrationTarget
  std::vector<Real> at;              ///< rad, ascending; of one pose 0
  std::vector<std::size_t> targets;
};
/// One per pair of coordinate and pose; arms at the ends of a curve ask for neighbors beyond it, too.
std::vector<TargetSweep> sweeps_of(const std::vector<CalibrationTarget>& targets);

/// All that decides about an observation, but for the scene: a line each.
std::string observation_definition(const std::vector<CalibrationTarget>& targets);

/// Takes the scene through all sweeps, as `gracilis rom` does, each from the capture pose on. Throws QualityError where
/// the method fails, Interrupted soon after `stop` is set. Precondition: match_scene found nothing.
Observation observe(const LoadedScene& loaded, const std::vector<CalibrationTarget>& targets,
                    const std::atomic<bool>& stop);

}  // namespace gracilis
