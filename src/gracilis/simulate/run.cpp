#include <gracilis/simulate/run.hpp>

#include <gracilis/core/errors.hpp>

namespace gracilis {

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
  Measurer measurer(scene, tracker);
  int next = 0;
  method.reset();
  if (resume) {
    next = resume->last.number + 1;
    method.restore({poses.begin(), poses.begin() + next}, resume->before, resume->last);
    for (int i = 0; i < next; ++i) measurer.pass(poses[static_cast<std::size_t>(i)]);
  }
  for (; next < static_cast<int>(poses.size()); ++next) {
    if (stop) return RunEnd::interrupted;
    FrameRecord now;
    const Pose& pose = poses[static_cast<std::size_t>(next)];
    if (next == 0) {
      now.frame = capture_frame(scene, pose);
      now.report.muscles.resize(scene.muscles.size());
    } else {
      try {
        now.report = method.advance(pose);
      } catch (const QualityError& error) {
        throw QualityError("frame " + std::to_string(next) + ": " + error.what());
      }
      now.frame.pose = pose;
      method.write(now.frame);
    }
    now.frame.number = next;
    if (tracker) now.fibers = tracker->follow(now.frame);
    now.measures = measurer.measure(now.frame, now.fibers);
    record(now);
  }
  return RunEnd::complete;
}

}  // namespace gracilis
