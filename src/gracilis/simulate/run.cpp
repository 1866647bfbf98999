#include <gracilis/simulate/run.hpp>

#include <gracilis/anatomy/joints/joint_twists.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/core/stop.hpp>

#include <future>
#include <utility>

namespace gracilis {

namespace {

/// s, that pass before a pose; the usual time where poses say nothing of theirs.
Real time_before(const std::vector<Pose>& poses, int number) {
  const auto at = static_cast<std::size_t>(number);
  const Real passed = poses[at].time - poses[at - 1].time;
  return passed > 0 ? passed : usual_time_step;
}

/// One frame, not measured yet. Throws Interrupted where it shall stop.
FrameRecord make_frame(const Scene& scene, const std::vector<Pose>& poses, int number, bool fiber_actions,
                       DeformationMethod& method) {
  throw_if_stopped();
  const Pose& pose = poses[static_cast<std::size_t>(number)];
  FrameRecord now;
  if (number == 0) {
    now.frame = capture_frame(scene, pose, method);
    now.report.muscles.resize(scene.muscles.size());
  } else {
    try {
      now.report = method.advance(pose, time_before(poses, number));
    } catch (const QualityError& error) {
      throw QualityError("frame " + std::to_string(number) + ": " + error.what());
    }
    now.frame.pose = pose;
    method.write(now.frame);
  }
  now.frame.number = number;
  const std::vector<std::vector<Twist>> twists = joint_twists(scene, pose.coordinates);
  if (fiber_actions) now.actions = method.fiber_actions(twists);
  now.forces = method.muscle_forces(twists);
  return now;
}

/// Measures frames and hands them on, one after the other, each beside whatever its caller does next: the solver alone
/// leaves cores idle now and then. What it begins it brings to an end, however the run is stopped.
class FrameRecorder {
 public:
  FrameRecorder(Measurer& measurer, const FiberTracker* tracker, const std::function<void(const FrameRecord&)>& record,
                bool beside)
      : measurer_(measurer), tracker_(tracker), record_(record), beside_(beside) {}

  void begin(FrameRecord now) {
    finish();
    pending_ = std::async(beside_ ? std::launch::async : std::launch::deferred, [this, now = std::move(now)]() mutable {
      const StopScope whole(nullptr);  // a frame is recorded whole or not at all
      if (tracker_) now.fibers = tracker_->follow(now.frame);
      now.measures = measurer_.measure(now.frame, now.fibers);
      record_(now);
    });
    if (!beside_) finish();
  }

  /// Waits until everything is recorded; throws what that threw.
  void finish() {
    if (pending_.valid()) pending_.get();
  }

 private:
  Measurer& measurer_;
  const FiberTracker* tracker_;
  const std::function<void(const FrameRecord&)>& record_;
  bool beside_;
  std::future<void> pending_;
};

/// Whether frames may be recorded beside the solver: not on a single thread, nor where the solver watches the clock.
bool may_record_beside(const DeformationMethod& method) { return thread_count() > 1 && !method.watches_clock(); }

}  // namespace

Frame capture_frame(const Scene& scene, const Pose& pose) {
  Frame frame;
  frame.pose = pose;
  for (const Muscle& muscle : scene.muscles) frame.muscles.push_back({muscle.surface.vertices});
  return frame;
}

Frame capture_frame(const Scene& scene, const Pose& pose, const DeformationMethod& method) {
  Frame frame = capture_frame(scene, pose), written;
  written.pose = pose;
  method.write(written);
  for (std::size_t m = 0; m < frame.muscles.size(); ++m) frame.muscles[m].fibers = std::move(written.muscles[m].fibers);
  return frame;
}

RunEnd run_scene(const Scene& scene, const std::vector<Pose>& poses, DeformationMethod& method,
                 const ResumePoint* resume, const std::atomic<bool>& stop,
                 const std::function<void(const FrameRecord&)>& record, const FiberTracker* tracker,
                 bool fiber_actions) {
  try {
    const StopScope scope(&stop);
    Measurer measurer(scene, tracker);
    method.reset();
    int next = 0;
    if (resume) {
      next = resume->last.number + 1;
      method.restore({poses.begin(), poses.begin() + next}, resume->before, resume->last);
      for (int i = 0; i < next; ++i) measurer.pass(poses[static_cast<std::size_t>(i)]);
    }
    FrameRecorder recorder(measurer, tracker, record, may_record_beside(method));
    for (; next < static_cast<int>(poses.size()); ++next) {
      FrameRecord now;
      try {
        now = make_frame(scene, poses, next, fiber_actions, method);
      } catch (...) {
        recorder.finish();
        throw;
      }
      recorder.finish();
      throw_if_stopped();
      recorder.begin(std::move(now));
    }
    recorder.finish();
  } catch (const Interrupted&) {
    return RunEnd::interrupted;
  }
  return RunEnd::complete;
}

}  // namespace gracilis
