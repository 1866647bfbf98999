#include "live_state.hpp"

#include "arrays.hpp"
#include "released.hpp"

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/io/scene/field_cache.hpp>
#include <gracilis/methods/registry.hpp>

#include <chrono>
#include <numeric>
#include <utility>

namespace py = pybind11;

namespace gracilis::python {

LiveState::LiveState(LoadedScene loaded) : loaded_(std::move(loaded)) {
  for (const Muscle& muscle : scene().muscles) planned.push_back(drives(scene().activation, muscle.name));
  drive_all(loaded_.scene);
  simulation_ = released([this] {
    const auto fields = [this](const DistanceFieldSettings& settings) { return cached_bone_fields(scene(), settings); };
    return std::make_unique<Simulation>(scene(), make_method(scene(), fields));
  });
  look_at(simulation_->frame());
  coordinates = capture_coordinates(scene());
  activations.assign(scene().muscles.size(), 0);
}

template <class Work>
auto LiveState::work(const Work& act) {
  return released([&] {
    const std::lock_guard lock(working_);
    return act(*simulation_);
  });
}

void LiveState::look_at(std::shared_ptr<const Frame> frame) {
  facts_ = {std::move(frame), {}, {}, {}};
  const py::capsule owner = keeper(facts_.frame);
  for (const MuscleShape& shape : facts_.frame->muscles) facts_.vertices.push_back(rows_view(shape.points, owner));
}

void LiveState::advance(Pose pose, Real time_step) {
  std::chrono::steady_clock::duration taken{};
  look_at(work([&](Simulation& simulation) {
    if (simulation.is_broken())
      throw Error(ExitCode::usage, "the simulation was stopped within a frame: reset() or restore() it");
    if (pose.bodies.empty()) pose.bodies = pose_at(scene(), pose.coordinates).bodies;
    const auto begin = std::chrono::steady_clock::now();
    simulation.advance(pose, time_step);
    taken = std::chrono::steady_clock::now() - begin;
    return simulation.frame();
  }));
  solver_seconds_ = std::chrono::duration<Real>(taken).count();
}

void LiveState::reset() {
  look_at(work([&](Simulation& simulation) {
    simulation.reset();
    return simulation.frame();
  }));
  coordinates = capture_coordinates(scene());
  activations.assign(scene().muscles.size(), 0);
}

Checkpoint LiveState::checkpoint() {
  return work([](Simulation& simulation) {
    if (simulation.is_broken()) throw Error(ExitCode::usage, "the simulation was stopped within a frame");
    return simulation.checkpoint();
  });
}

void LiveState::restore(const Checkpoint& checkpoint) {
  look_at(work([&](Simulation& simulation) {
    simulation.restore(checkpoint);
    return simulation.frame();
  }));
  coordinates = frame().pose.coordinates;
  activations = frame().pose.activations;
  activations.resize(scene().muscles.size());
}

std::shared_ptr<const std::vector<MuscleFibers>> LiveState::fibers() {
  if (facts_.fibers) return facts_.fibers;
  const std::shared_ptr<const Frame> frame = facts_.frame;
  auto made = work([&](Simulation& simulation) {
    return std::make_shared<const std::vector<MuscleFibers>>(simulation.tracker().follow(*frame));
  });
  if (facts_.frame == frame) facts_.fibers = made;
  return made;
}

std::shared_ptr<const std::vector<std::vector<float>>> LiveState::depths() {
  if (facts_.depths) return facts_.depths;
  const std::shared_ptr<const Frame> frame = facts_.frame;
  auto made = work([&](Simulation&) {
    if (!contact_) {
      std::vector<TriangleMesh> bones;
      for (const Bone& bone : scene().bones) bones.push_back(bone.surface);
      contact_.emplace(bones);
    }
    std::vector<TriangleMesh> muscles;
    std::vector<std::vector<Index>> all;
    for (std::size_t m = 0; m < scene().muscles.size(); ++m) {
      muscles.push_back({frame->muscles[m].points, scene().muscles[m].surface.faces});
      std::vector<Index>& numbers = all.emplace_back(static_cast<std::size_t>(muscles[m].vertex_count()));
      std::iota(numbers.begin(), numbers.end(), 0);
    }
    std::vector<RigidTransform> moved;
    for (const Bone& bone : scene().bones) moved.push_back(frame->pose.bodies[static_cast<std::size_t>(bone.body)]);
    return std::make_shared<const std::vector<std::vector<float>>>(contact_->of(muscles, all, moved));
  });
  if (facts_.frame == frame) facts_.depths = made;
  return made;
}

}  // namespace gracilis::python
