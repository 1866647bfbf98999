#include <gracilis/view/window/live_simulation.hpp>

#include <gracilis/anatomy/activation/tendon.hpp>
#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/anatomy/pose_sequence.hpp>
#include <gracilis/core/failure.hpp>
#include <gracilis/core/stop.hpp>
#include <gracilis/methods/pass_tracing.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/simulate/run.hpp>
#include <gracilis/view/pictures/pose_caption.hpp>
#include <gracilis/view/window/bone_pull.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace gracilis {

// What a method takes in one step.
static constexpr Real largest_turn = radians(1.25);
static constexpr Real largest_shift = 0.001;  // m, of coordinates that are translations
static constexpr Real largest_activation = 0.05;
static constexpr int kept_passes = 60;  // steps; they are large

/// What each vertex holds on to.
static std::vector<HeldAt> held_vertices(const Muscle& muscle) {
  std::vector<HeldAt> held(static_cast<std::size_t>(muscle.surface.vertex_count()), HeldAt::nothing);
  for (const Attachment& attachment : muscle.attachments)
    for (const Index v : attachment.vertices)
      held[static_cast<std::size_t>(v)] = attachment.end == AttachmentEnd::origin ? HeldAt::origin : HeldAt::insertion;
  return held;
}

LiveSimulation::LiveSimulation(const Scene& scene, ShapeHistory& history,
                               std::function<std::unique_ptr<DeformationMethod>()> make_method)
    : scene_(scene),
      history_(history),
      make_method_(std::move(make_method)),
      motion_(pose_sequence(scene)),
      motion_at_(motion_.size()) {
  shapes_.title = scene.name;
  shapes_.axes = scene.axes;
  std::vector<TriangleMesh> muscles, bones;
  std::size_t left = 0;
  for (const Muscle& muscle : scene.muscles) {
    shapes_.muscles.push_back(muscle.name);
    if (muscle.name.ends_with("_l")) ++left;
    muscles.push_back(muscle.surface);
  }
  shapes_.left_side = 2 * left > scene.muscles.size();
  for (const Bone& bone : scene.bones) {
    shapes_.bones.push_back(bone.name);
    bones.push_back(bone.surface);
  }
  maker_.emplace(std::move(muscles), std::move(bones), shapes_);
  for (std::size_t m = 0; m < scene.muscles.size(); ++m) {
    maker_->paint(m, muscle_look(scene.muscles[m]), shapes_);
    shapes_.held[m] = maker_->shown_of(m, held_vertices(scene.muscles[m]));
    const std::vector<Real> belly =
        maker_->shown_of(m, belly_shares(scene.muscles[m], tendon_length_of(scene, scene.muscles[m])));
    shapes_.belly[m].assign(belly.begin(), belly.end());
  }
  wanted_ = {capture_coordinates(scene), std::vector<Real>(scene.muscles.size())};
  reached_ = wanted_;
  history_.append(shown(capture_frame(scene, pose_at(scene, reached_.coordinates))));
  thread_ = std::thread([this] { work(); });
}

LiveSimulation::~LiveSimulation() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

/// Call it behind the lock.
void LiveSimulation::expect_motion() {
  if (status_ == "ready") status_ = "moving";
}

void LiveSimulation::aim(std::size_t coordinate, Real value) {
  const std::lock_guard lock(mutex_);
  wanted_.coordinates.at(coordinate) = value;
  motion_at_ = motion_.size();
  expect_motion();
  changed_.notify_all();
}

bool LiveSimulation::pull(std::size_t bone, const Vec3& point, const Vec3& target, const Vec3& looking) {
  const std::lock_guard lock(mutex_);
  if (!pull_bone(scene_, bone, point, target, looking, wanted_.coordinates)) return false;
  motion_at_ = motion_.size();
  expect_motion();
  changed_.notify_all();
  return true;
}

Real LiveSimulation::aim_of(std::size_t coordinate) const {
  const std::lock_guard lock(mutex_);
  return wanted_.coordinates.at(coordinate);
}

void LiveSimulation::activate(std::size_t muscle, Real activation) {
  const std::lock_guard lock(mutex_);
  wanted_.activations.at(muscle) = activation;
  motion_at_ = motion_.size();
  expect_motion();
  changed_.notify_all();
}

Real LiveSimulation::activation_of(std::size_t muscle) const {
  const std::lock_guard lock(mutex_);
  return wanted_.activations.at(muscle);
}

void LiveSimulation::play_motion() {
  const std::lock_guard lock(mutex_);
  motion_at_ = 0;
  expect_motion();
  paused_ = false;
  changed_.notify_all();
}

void LiveSimulation::pause(bool on) {
  const std::lock_guard lock(mutex_);
  paused_ = on;
  single_steps_ = 0;
  if (!on) expect_motion();
  changed_.notify_all();
}

bool LiveSimulation::is_paused() const {
  const std::lock_guard lock(mutex_);
  return paused_;
}

void LiveSimulation::step_once() {
  const std::lock_guard lock(mutex_);
  ++single_steps_;
  changed_.notify_all();
}

void LiveSimulation::look_again() {
  const std::lock_guard lock(mutex_);
  look_again_ = true;
  expect_motion();
  changed_.notify_all();
}

void LiveSimulation::reset() {
  const std::lock_guard lock(mutex_);
  wanted_ = {capture_coordinates(scene_), std::vector<Real>(scene_.muscles.size())};
  motion_at_ = motion_.size();
  reset_ = true;
  expect_motion();
  changed_.notify_all();
}

std::string LiveSimulation::status() const {
  const std::lock_guard lock(mutex_);
  return paused_ && status_ != "preparing" ? "paused" : status_;
}

void LiveSimulation::tell(const std::string& status) {
  const std::lock_guard lock(mutex_);
  status_ = status;
}

/// One step of all values towards where they are wanted; false when they are there. Where the scene's motion plays,
/// its next pose is wanted as soon as the last is reached.
bool LiveSimulation::approach() {
  if (motion_at_ < motion_.size()) {
    if (reached_.coordinates == wanted_.coordinates && reached_.activations == wanted_.activations) ++motion_at_;
    if (motion_at_ < motion_.size()) {
      wanted_.coordinates = motion_[motion_at_].coordinates;
      wanted_.activations = motion_[motion_at_].activations;
      wanted_.activations.resize(scene_.muscles.size());
    }
  }
  const auto move = [](Real& value, Real wanted, Real most) {
    if (value == wanted) return false;
    value += std::clamp(wanted - value, -most, most);
    return true;
  };
  bool moved = false;
  std::size_t i = 0;
  for (const Joint& joint : scene_.joints)
    for (const JointAxis& axis : joint.axes) {
      moved |= move(reached_.coordinates[i], wanted_.coordinates[i], axis.translation ? largest_shift : largest_turn);
      ++i;
    }
  for (std::size_t m = 0; m < scene_.muscles.size(); ++m)
    moved |= move(reached_.activations[m], wanted_.activations[m], largest_activation);
  return moved;
}

/// Behind the lock.
bool LiveSimulation::may_step() {
  if (!paused_) return approach();
  if (single_steps_ == 0) return false;
  --single_steps_;
  approach();
  return true;
}

void LiveSimulation::prepare() {
  simulation_.emplace(scene_, make_method_(), Simulation::Keeps::last_frame);
  simulation_->tracker();
  history_.replace(0, shown(*simulation_->frame()));
  tell("ready");
  spdlog::info("ready: pull the sliders");
}

/// Collects what the next step moves, where somebody wants to see it.
void LiveSimulation::trace_passes() {
  passes_.clear();
  PassTracing* tracing = simulation_->method().pass_tracing();
  if (!tracing) return;
  if (!history_.requests.passes) {
    tracing->trace_passes({});
    return;
  }
  tracing->trace_passes([this](const SolverPass& pass) {
    ShownPass shown{pass.muscle, pass.kind, pass.iteration,
                    picked(pass.moved, maker_->arrow_vertices(pass.muscle)).cast<float>()};
    if (shown.moved.isZero(0)) return;
    const std::lock_guard lock(passes_mutex_);
    passes_.push_back(std::move(shown));
  });
}

void LiveSimulation::step(int number) {
  Pose pose = pose_at(scene_, reached_.coordinates);
  pose.activations = reached_.activations;
  pose.time = number / 60.0;
  const auto begin = std::chrono::steady_clock::now();
  trace_passes();
  simulation_->advance(pose, usual_time_step);
  milliseconds_ = std::chrono::duration<Real, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

/// What is to be done next; waits until there is something.
LiveSimulation::Task LiveSimulation::next_task() {
  std::unique_lock lock(mutex_);
  while (true) {
    if (stop_) return Task::stop;
    if (std::exchange(look_again_, false)) return Task::look_again;
    if (std::exchange(reset_, false)) {
      reached_ = wanted_;
      status_ = "moving";  // also from where it had stopped
      return Task::reset;
    }
    if (may_step()) {
      status_ = "moving";
      return Task::step;
    }
    if (status_ == "moving") status_ = "ready";
    changed_.wait(lock);
  }
}

void LiveSimulation::work() {
  const StopScope scope(&stop_);
  int last = 0;  // of all steps, also those before a reset
  for (Task task = Task::step; task != Task::stop;) {
    try {
      if (!simulation_) prepare();
      task = next_task();
      if (task == Task::reset) simulation_->reset();
      if (task == Task::step || task == Task::reset) {
        step(last + 1);
        ++last;
        history_.append(shown(*simulation_->frame()));
        history_.forget_passes(last - kept_passes);
      }
      if (task == Task::look_again) history_.replace(last, shown(*simulation_->frame()));
    } catch (const Interrupted&) {
      return;
    } catch (const std::exception&) {
      const std::string reason = current_failure().text;
      spdlog::error("the simulation has stopped: {}", reason);
      std::unique_lock lock(mutex_);
      status_ = "stopped: " + reason;
      changed_.wait(lock, [this] { return stop_ || (reset_ && simulation_); });
    }
  }
}

/// Tensions cost the method some time, so only while somebody looks at them.
void LiveSimulation::fill_forces(const Frame& frame, ShownFrame& result) const {
  std::vector<Eigen::VectorXd> stresses, tensions(frame.muscles.size());
  for (const MuscleShape& shape : frame.muscles) stresses.push_back(shape.fiber_stresses);
  maker_->fill_stress(stresses, result);
  if (history_.requests.tension && simulation_) {
    const std::vector<MuscleForces> forces = simulation_->method().muscle_forces({});
    for (std::size_t m = 0; m < forces.size(); ++m)
      tensions[m] = Eigen::Map<const Eigen::VectorXd>(forces[m].fiber_tensions.data(),
                                                      static_cast<Index>(forces[m].fiber_tensions.size()));
  }
  FrameMaker::fill_tension(tensions, result);
}

ShownFrame LiveSimulation::shown(const Frame& frame) {
  ShownFrame result;
  result.caption = pose_caption(scene_, frame);
  std::vector<Points> muscles;
  for (const MuscleShape& shape : frame.muscles) muscles.push_back(shape.points);
  std::vector<RigidTransform> bones;
  for (const Bone& bone : scene_.bones) bones.push_back(frame.pose.bodies[static_cast<std::size_t>(bone.body)]);
  maker_->fill(muscles, std::move(bones), history_.requests.contact_depth, result);
  std::vector<Polylines> fibers(scene_.muscles.size());
  if (simulation_) {
    const std::vector<MuscleFibers> followed = simulation_->tracker().follow(frame);
    for (std::size_t m = 0; m < fibers.size(); ++m) fibers[m] = followed[m].lines;
    maker_->fill_fibers(fibers, result);
  } else {
    result.fibers = fibers;
    result.strain.resize(fibers.size());
  }
  fill_forces(frame, result);
  result.activation = frame.pose.activations;
  result.activation.resize(scene_.muscles.size());
  result.milliseconds = milliseconds_;
  result.passes = passes_;
  return result;
}

}  // namespace gracilis
