#pragma once

#include <gracilis/methods/method.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/simulate/simulation.hpp>
#include <gracilis/view/window/frame_maker.hpp>
#include <gracilis/view/window/shape_history.hpp>

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace gracilis {

/// A scene that moves to where its coordinates are told to go, on a thread of its own. Every step becomes a frame of
/// the history, so that what happened can be looked at again. All functions may be called from any thread, and return
/// at once.
class LiveSimulation {
 public:
  /// Appends the capture pose at once; `make_method` is called on the thread, for preparing takes seconds. Scene and
  /// history must outlive this. Precondition: the scene is valid.
  LiveSimulation(const Scene& scene, ShapeHistory& history,
                 std::function<std::unique_ptr<DeformationMethod>()> make_method);
  ~LiveSimulation();
  LiveSimulation(const LiveSimulation&) = delete;
  LiveSimulation& operator=(const LiveSimulation&) = delete;

  const ShownShapes& shapes() const { return shapes_; }  ///< what of the scene does not change
  /// Where a coordinate shall go (rad, m), in the order of coordinate_names().
  void aim(std::size_t coordinate, Real value);
  /// Where it shall go, rad or m.
  Real aim_of(std::size_t coordinate) const;
  /// Aims at coordinates as pull_bone does (bone_pull.hpp).
  bool pull(std::size_t bone, const Vec3& point, const Vec3& target, const Vec3& looking);
  /// How active a muscle shall be, 0 to 1.
  void activate(std::size_t muscle, Real activation);
  /// How active it shall be, 0 to 1.
  Real activation_of(std::size_t muscle) const;
  /// Through the scene's own motion, until it ends or a slider is moved.
  void play_motion();
  void pause(bool on);     ///< stops steps, or lets them go on
  bool is_paused() const;  ///< by `pause`
  /// One more step while paused, even where nothing is left to move.
  void step_once();
  /// Makes the last frame again, with what is wished for now.
  void look_again();
  /// Back to the capture pose, whatever happened.
  void reset();
  /// "preparing", "ready", "moving", "paused", or what went wrong.
  std::string status() const;

 private:
  struct Wanted {
    std::vector<Real> coordinates, activations;
  };
  enum class Task { step, reset, look_again, stop };
  void work();
  void prepare();
  Task next_task();
  bool approach();
  bool may_step();
  void expect_motion();
  void trace_passes();
  void step(int number);
  ShownFrame shown(const Frame& frame);
  void fill_forces(const Frame& frame, ShownFrame& result) const;
  void tell(const std::string& status);

  const Scene& scene_;
  ShapeHistory& history_;
  std::function<std::unique_ptr<DeformationMethod>()> make_method_;
  ShownShapes shapes_;
  std::optional<FrameMaker> maker_;
  const std::vector<Pose> motion_;
  // Of the simulation's thread.
  std::optional<Simulation> simulation_;
  Wanted reached_;
  Real milliseconds_ = 0;  ///< of the last step
  std::mutex passes_mutex_;
  std::vector<ShownPass> passes_;  ///< of the last step
  // Of all, behind the lock.
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Wanted wanted_;
  std::size_t motion_at_;  ///< next pose of the motion; its end: it does not play
  int single_steps_ = 0;
  bool paused_ = false, reset_ = false, look_again_ = false;
  std::atomic<bool> stop_ = false;  ///< also without the lock, from within a step
  std::string status_ = "preparing";
  std::thread thread_;
};

}  // namespace gracilis
