#pragma once

#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/simulate/simulation.hpp>
#include <gracilis/view/window/contact_depth.hpp>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace gracilis::python {

/// What is known about the present frame; of fibers and depths, when it is asked for.
struct FrameFacts {
  std::shared_ptr<const Frame> frame;
  std::vector<pybind11::object> vertices;  ///< views, per muscle: a first look finds them
  std::shared_ptr<const std::vector<MuscleFibers>> fibers;
  std::shared_ptr<const std::vector<std::vector<float>>> depths;
};

/// A simulation with all that views of it need. What changes is touched with the interpreter's lock held only, but for
/// `simulation`, which whoever holds `working` moves without it.
class LiveState {
 public:
  explicit LiveState(LoadedScene loaded);

  const Scene& scene() const { return loaded_.scene; }
  const Frame& frame() const { return *facts_.frame; }
  /// s that the last advance() was in the simulation, without what Python adds; 0 before the first.
  Real solver_seconds() const { return solver_seconds_; }

  void advance(Pose pose, Real time_step);
  void reset();
  Checkpoint checkpoint();
  void restore(const Checkpoint& checkpoint);

  pybind11::object vertices(std::size_t muscle) const { return facts_.vertices[muscle]; }
  std::shared_ptr<const std::vector<MuscleFibers>> fibers();
  std::shared_ptr<const std::vector<std::vector<float>>> depths();

  std::vector<Real> coordinates;  ///< rad (m), where the next step begins to ask from
  std::vector<Real> activations;
  std::vector<bool> planned;  ///< per muscle: whether the scene itself says how active it is

 private:
  /// Has the simulation do something without the interpreter's lock.
  template <class Work>
  auto work(const Work& act);
  void look_at(std::shared_ptr<const Frame> frame);

  LoadedScene loaded_;
  std::mutex working_;
  std::unique_ptr<Simulation> simulation_;
  std::optional<ContactDepth> contact_;  ///< made when it is asked for
  FrameFacts facts_;
  Real solver_seconds_ = 0;
};

}  // namespace gracilis::python
