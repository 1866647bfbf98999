#pragma once

#include <gracilis/methods/method.hpp>
#include <gracilis/scene/frame.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/simulate/capture_frame.hpp>
#include <gracilis/simulate/corrections.hpp>
#include <gracilis/simulate/fiber_tracker.hpp>
#include <gracilis/simulate/measures.hpp>

#include <atomic>
#include <functional>
#include <vector>

namespace gracilis {

/// Everything that one frame of a run says.
struct FrameRecord {
  Frame frame;
  StepReport report;                      ///< empty muscles in frame 0
  std::vector<MuscleMeasures> measures;   ///< in the scene's order
  std::vector<MuscleFibers> fibers = {};  ///< in the scene's order; empty where fibers are not followed
  /// In the scene's order, about its coordinates in theirs; empty where the method knows none or nobody asked.
  std::vector<FiberActions> actions = {};
  std::vector<MuscleForces> forces = {};  ///< in the scene's order; empty where the method knows none
  /// In the scene's order, since the frame before (of frame 0 no kind); empty where nobody asked.
  std::vector<Corrections> corrections = {};
};

/// Where an interrupted run goes on: a frame whose number is a multiple of resume_period(scene), and the one before it.
struct ResumePoint {
  Frame before, last;
};

enum class RunEnd { complete, interrupted };

/// What of a run is recorded.
struct RunChoices {
  bool fiber_actions = false;  ///< the method is asked for these in every frame
  MeasureLevel measures = MeasureLevel::full;
  /// The poses whose frames are recorded, ascending, beginning with 0; frames are numbered by their places in this.
  /// Empty: all.
  std::vector<int> recorded = {};
  bool corrections = false;  ///< frames tell what constraints moved since the one before
};

/// Runs `method` through `poses` (pose 0 is the capture pose) and hands each frame to `record`, frame 0 with the input
/// surfaces unchanged. Ends soon after `stop` is set; the frame under way is dropped, and the method is of no use until
/// its next reset or restore. With `resume`, starts after its last frame; where not all frames are recorded, the method
/// goes through all again up to there. Throws QualityError, naming the pose, when a coordinate stops being finite; all
/// frames before it have been recorded then. Frames are measured and recorded in order, but on a thread of their own
/// while the next one is made. With `tracker`, fibers are followed. Throws ConfigurationError where corrections are
/// asked for and the method has none.
RunEnd run_scene(const Scene& scene, const std::vector<Pose>& poses, DeformationMethod& method,
                 const ResumePoint* resume, const std::atomic<bool>& stop,
                 const std::function<void(const FrameRecord&)>& record, const FiberTracker* tracker = nullptr,
                 const RunChoices& choices = {});

/// s, that pass before pose `number` (above 0); the usual time where poses say nothing of theirs.
Real time_before(const std::vector<Pose>& poses, int number);

}  // namespace gracilis
