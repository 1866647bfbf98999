#include <gracilis/simulate/run.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/stop.hpp>

namespace gracilis {

namespace {

/// Everything about one frame. Throws Interrupted where it shall stop.
FrameRecord make_frame(const Scene& scene, const Pose& pose, int number, DeformationMethod& method, Measurer& measurer,
                       const FiberTracker* tracker) {
  throw_if_stopped();
  FrameRecord now;
  if (number == 0) {
    now.frame = capture_frame(scene, pose);
    now.report.muscles.resize(scene.muscles.size());
  } else {
    try {
      now.report = method.advance(pose);
    } catch (const QualityError& error) {
      throw QualityError("frame " + std::to_string(number) + ": " + error.what());
    }
    now.frame.pose = pose;
    method.write(now.frame);
  }
  now.frame.number = number;
  if (tracker) now.fibers = tracker->follow(now.frame);
  now.measures = measurer.measure(now.frame, now.fibers);
  return now;
}

}  // namespace

Frame capture_frame(const Scene& scene, const Pose& pose) {
  Frame frame;
  frame.pose = pose;
  for (const Muscle& muscle : scene.muscles) frame.muscles.push_back({muscle.surface.vertices});
  return frame;
}

int resume_period(const Scene& scene) {
  const bool remembers = scene.method == MethodKind::xpbd && scene.contact.muscle != MuscleContact::none;
  return remembers ? scene.contact.update_period : 1;
}

RunEnd run_scene(const Scene& scene, const std::vector<Pose>& poses, DeformationMethod& method,
                 const ResumePoint* resume, const std::atomic<bool>& stop,
                 const std::function<void(const FrameRecord&)>& record, const FiberTracker* tracker) {
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
    for (; next < static_cast<int>(poses.size()); ++next) {
      const Pose& pose = poses[static_cast<std::size_t>(next)];
      const FrameRecord now = make_frame(scene, pose, next, method, measurer, tracker);
      const StopScope whole(nullptr);  // a frame is recorded whole or not at all
      record(now);
    }
  } catch (const Interrupted&) {
    return RunEnd::interrupted;
  }
  return RunEnd::complete;
}

}  // namespace gracilis
