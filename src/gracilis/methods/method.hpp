#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/scene/fiber_actions.hpp>
#include <gracilis/scene/frame.hpp>
#include <gracilis/scene/muscle_forces.hpp>
#include <gracilis/scene/pose.hpp>
#include <gracilis/scene/twist.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace gracilis {

/// A number that a method tells of a step. The name ends with the unit where there is one, as in largest_correction_mm.
struct Metric {
  std::string_view name;
  Real value = 0;
};
using Metrics = std::vector<Metric>;

/// The value with this name; 0 where there is none.
inline Real metric(const Metrics& metrics, std::string_view name) {
  for (const Metric& each : metrics)
    if (each.name == name) return each.value;
  return 0;
}

/// What happened to one muscle in one frame.
struct MuscleReport {
  Real milliseconds = 0;
  Metrics metrics = {};  ///< with the names that the method's entry lists
};

struct StepReport {
  std::vector<MuscleReport> muscles;  ///< in the scene's order
  Metrics metrics = {};               ///< of all muscles together
};

class PassTracing;  // methods/pass_tracing.hpp

/// A way to deform muscles, prepared for one scene. The problem it solves: given where every body is, where are the
/// surfaces of the muscles? At the capture pose the answer is the input itself. Rigid motion of all bodies moves the
/// answer rigidly; the answer is finite, or QualityError is thrown; it has the same bits for any number of threads.
class DeformationMethod {
 public:
  virtual ~DeformationMethod() = default;

  /// Back to the capture pose: frame 0.
  virtual void reset() = 0;
  /// To the next pose, `time_step` (s, above 0) later. Throws QualityError that names the muscle, and what it was
  /// after, when a coordinate stops being finite; the state is then that before the call. Throws Interrupted where a
  /// StopScope says so; only reset and restore make sense then.
  virtual StepReport advance(const Pose& pose, Real time_step) = 0;
  /// The present shapes, into frame.muscles.
  virtual void write(Frame& frame) const = 0;
  /// Continues from a recorded frame and the one before it, as if this method had made them: to the same bits from a
  /// frame whose number is a multiple of resume_period(scene). `poses` are those of all frames from the capture pose up
  /// to the last, for what a method follows through them.
  virtual void restore(const std::vector<Pose>& poses, const Frame& before, const Frame& last) = 0;

  /// From now on only lengths and arms of fibers are asked for: where a method knows those of a muscle by itself, its
  /// frames may have no points of that muscle, and its actions no wrenches.
  virtual void give_lengths_and_arms() {}

  /// Whether what it computes depends on how fast the machine is; nothing should run beside it then.
  virtual bool depends_on_clock() const { return false; }
  /// What has to be known about all frames since the capture pose together; empty: nothing.
  virtual std::string remark() const { return {}; }
  /// What the fibers do to the bodies in the present pose, per muscle in the scene's order. `coordinates`: per
  /// coordinate, how it moves every body. Of methods that hold fibers in an equilibrium; empty: it does not.
  virtual std::vector<FiberActions> fiber_actions(const std::vector<std::vector<Twist>>&) const { return {}; }
  /// What the muscles do to the bodies in the present pose, in the scene's order. Of methods whose muscles are under
  /// tension; empty: it knows no forces.
  virtual std::vector<MuscleForces> muscle_forces(const std::vector<std::vector<Twist>>&) const { return {}; }
  /// Of methods that have passes; null: it has none.
  virtual PassTracing* pass_tracing() { return nullptr; }
};

}  // namespace gracilis
