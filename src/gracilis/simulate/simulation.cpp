#include <gracilis/simulate/simulation.hpp>

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/core/stop.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/simulate/capture_frame.hpp>

#include <cassert>
#include <utility>

namespace gracilis {

void drive_all(Scene& scene) {
  for (const Muscle& muscle : scene.muscles)
    if (!drives(scene.activation, muscle.name)) scene.activation.signals.push_back({muscle.name, {0}, {0}});
}

Simulation::Simulation(const Scene& scene, std::unique_ptr<DeformationMethod> method, Keeps keeps)
    : scene_(scene), method_(std::move(method)), keeps_(keeps), period_(resume_period(scene)) {
  method_->reset();
  const Pose pose = pose_at(scene, capture_coordinates(scene));
  capture_ = std::make_shared<const Frame>(capture_frame(scene, pose, *method_));
  frame_ = capture_;
  going_on_ = {{}, capture_, capture_, {}};
}

void Simulation::reset() {
  method_->reset();
  frame_ = capture_;
  going_on_ = {{}, capture_, capture_, {}};
  broken_ = false;
}

StepReport Simulation::advance(const Pose& pose, Real time_step) {
  assert(!broken_);
  auto next = std::make_shared<Frame>();
  next->number = frame_->number + 1;
  next->pose = pose;
  StepReport report;
  try {
    report = method_->advance(pose, time_step);
  } catch (const Interrupted&) {
    broken_ = true;
    throw;
  }
  method_->write(*next);
  const std::shared_ptr<const Frame> before = std::exchange(frame_, std::move(next));
  if (keeps_ == Keeps::last_frame) return report;
  keep(pose, time_step);
  if (frame_->number % period_ == 0) {
    going_on_.before = before;
    going_on_.last = frame_;
    for (TakenStep& step : going_on_.since) going_on_.steps.push_back(std::move(step));
    going_on_.since.clear();
  }
  return report;
}

void Simulation::keep(const Pose& pose, Real time_step) {
  going_on_.since.push_back({{pose.time, pose.coordinates, {}, pose.activations}, time_step});
}

const FiberTracker& Simulation::tracker() {
  if (!tracker_) tracker_.emplace(scene_, capture_.get());
  return *tracker_;
}

Checkpoint Simulation::checkpoint() const {
  assert(keeps_ == Keeps::all_steps);
  return going_on_;
}

Pose Simulation::whole(const TakenStep& step) const {
  Pose pose = pose_at(scene_, step.pose.coordinates);
  pose.time = step.pose.time;
  pose.activations = step.pose.activations;
  return pose;
}

void Simulation::restore(const Checkpoint& checkpoint) {
  const Checkpoint wanted = checkpoint;  // it may be this simulation's own
  reset();
  if (!wanted.steps.empty()) {
    std::vector<Pose> poses = {capture_->pose};
    for (const TakenStep& step : wanted.steps) poses.push_back(whole(step));
    broken_ = true;  // until it stands where it shall
    method_->restore(poses, *wanted.before, *wanted.last);
    broken_ = false;
    frame_ = wanted.last;
    going_on_ = {wanted.steps, wanted.before, wanted.last, {}};
  }
  for (const TakenStep& step : wanted.since) advance(whole(step), step.time_step);
}

}  // namespace gracilis
