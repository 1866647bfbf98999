#pragma once

#include <gracilis/methods/method.hpp>
#include <gracilis/scene/frame.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/simulate/fiber_tracker.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace gracilis {

/// What a step was asked for.
struct TakenStep {
  Pose pose;  ///< without bodies: they follow from the coordinates
  Real time_step = 0;
};

/// Where a simulation goes on: the steps from the capture pose up to a frame from which its method goes on with the
/// same bits, that frame and the one before it, and the steps taken since.
struct Checkpoint {
  std::vector<TakenStep> steps;
  std::shared_ptr<const Frame> before, last;
  std::vector<TakenStep> since;
};

/// Lets every muscle contract, also those that the scene's own plan leaves relaxed; for simulations whose muscles may
/// become active at any moment.
void drive_all(Scene& scene);

/// A scene that is moved from outside, step by step. The frames it makes never change, so that whoever holds one may
/// look at it from any thread, as long as he likes.
class Simulation {
 public:
  enum class Keeps { last_frame, all_steps };

  /// Stands at the capture pose. Only a simulation that keeps its steps has checkpoints; a step takes as much memory as
  /// its coordinates and activations. The scene must outlive this. Precondition: `method` was made for it.
  Simulation(const Scene& scene, std::unique_ptr<DeformationMethod> method, Keeps keeps = Keeps::all_steps);

  /// Back to the capture pose, frame 0.
  void reset();
  /// To a pose, `time_step` (s, above 0) later. Throws as DeformationMethod::advance; the frame is then the last one.
  /// After Interrupted, only reset and restore are possible: `is_broken`.
  StepReport advance(const Pose& pose, Real time_step);
  bool is_broken() const { return broken_; }  ///< stopped within a frame: reset or restore it

  const std::shared_ptr<const Frame>& frame() const { return frame_; }  ///< the present one; it never changes
  /// Follows fibers through frames of this. Made when it is first asked for, which takes seconds.
  const FiberTracker& tracker();
  DeformationMethod& method() const { return *method_; }  ///< the one that moves the muscles

  /// Precondition: it keeps all steps.
  Checkpoint checkpoint() const;
  /// Goes on from a checkpoint of a simulation of the same scene by the same method, to the same bits; takes as long as
  /// the steps since the frame from which its method may go on (resume_period). Throws as advance.
  void restore(const Checkpoint& checkpoint);

 private:
  std::shared_ptr<const Frame> capture() const;
  void keep(const Pose& pose, Real time_step);
  Pose whole(const TakenStep& step) const;

  const Scene& scene_;
  std::unique_ptr<DeformationMethod> method_;
  Keeps keeps_;
  int period_;
  std::optional<FiberTracker> tracker_;
  std::shared_ptr<const Frame> capture_, frame_;
  Checkpoint going_on_;  ///< from here
  bool broken_ = false;
};

}  // namespace gracilis
