#include <gracilis/simulate/run.hpp>

#include <gracilis/anatomy/joints/joint_twists.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/core/stop.hpp>

#include <future>
#include <optional>
#include <utility>

namespace gracilis {

Real time_before(const std::vector<Pose>& poses, int number) {
  const auto at = static_cast<std::size_t>(number);
  const Real passed = poses[at].time - poses[at - 1].time;
  return passed > 0 ? passed : usual_time_step;
}

namespace {

/// The frame of a pose, not measured yet; where it is not `wanted`, the method takes the step and that is all. Throws
/// Interrupted where it shall stop.
FrameRecord make_frame(const Scene& scene, const std::vector<Pose>& poses, int number, bool wanted, bool fiber_actions,
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
    if (!wanted) return now;
    now.frame.pose = pose;
    method.write(now.frame);
  }
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

  /// `passed`: the poses between the last frame and this one.
  void begin(FrameRecord now, std::vector<Pose> passed) {
    finish();
    const auto policy = beside_ ? std::launch::async : std::launch::deferred;
    pending_ = std::async(policy, [this, now = std::move(now), passed = std::move(passed)]() mutable {
      const StopScope whole(nullptr);  // a frame is recorded whole or not at all
      for (const Pose& pose : passed) measurer_.pass(pose);
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
bool may_record_beside(const DeformationMethod& method) { return thread_count() > 1 && !method.depends_on_clock(); }

}  // namespace

RunEnd run_scene(const Scene& scene, const std::vector<Pose>& poses, DeformationMethod& method,
                 const ResumePoint* resume, const std::atomic<bool>& stop,
                 const std::function<void(const FrameRecord&)>& record, const FiberTracker* tracker,
                 const RunChoices& choices) {
  try {
    const StopScope scope(&stop);
    Measurer measurer(scene, tracker, choices.measures);
    method.reset();
    const bool all = choices.recorded.empty();
    const int done = resume ? resume->last.number + 1 : 0;  // frames that are recorded already
    int next = 0;
    if (resume && all) {
      next = done;
      method.restore({poses.begin(), poses.begin() + next}, resume->before, resume->last);
      for (int i = 0; i < next; ++i) measurer.pass(poses[static_cast<std::size_t>(i)]);
    }
    std::optional<CorrectionSum> corrections;
    if (choices.corrections) corrections.emplace(method, scene.muscles.size());
    FrameRecorder recorder(measurer, tracker, record, may_record_beside(method));
    int frame = next;
    std::vector<Pose> passed;
    for (; next < static_cast<int>(poses.size()); ++next) {
      const bool is_frame = all || (frame < static_cast<int>(choices.recorded.size()) &&
                                    choices.recorded[static_cast<std::size_t>(frame)] == next);
      const bool wanted = is_frame && frame >= done;
      FrameRecord now;
      try {
        now = make_frame(scene, poses, next, wanted, choices.fiber_actions, method);
      } catch (...) {
        recorder.finish();
        throw;
      }
      now.frame.number = frame;
      frame += is_frame;
      if (corrections && is_frame) now.corrections = corrections->take();
      if (!wanted) {
        passed.push_back(poses[static_cast<std::size_t>(next)]);
        continue;
      }
      recorder.finish();
      throw_if_stopped();
      recorder.begin(std::move(now), std::exchange(passed, {}));
    }
    recorder.finish();
  } catch (const Interrupted&) {
    return RunEnd::interrupted;
  }
  return RunEnd::complete;
}

}  // namespace gracilis
