#pragma once

#include <gracilis/io/run/recorded_run.hpp>
#include <gracilis/view/pictures/pose_caption.hpp>
#include <gracilis/view/window/frame_maker.hpp>
#include <gracilis/view/window/shape_history.hpp>

#include <atomic>
#include <optional>
#include <thread>
#include <vector>

namespace gracilis {

/// Reads a run's frames for a window: the first at once, the others one after the other on a thread of its own, and
/// then what the window asks for beside.
class RunLoader {
 public:
  /// Throws InputError when the first frame is damaged. The run and the history must outlive this.
  RunLoader(const RecordedRun& run, ShapeHistory& history);
  ~RunLoader();
  RunLoader(const RunLoader&) = delete;
  RunLoader& operator=(const RunLoader&) = delete;

  const ShownShapes& shapes() const { return shapes_; }  ///< what of the run does not change
  /// The bones' surfaces at rest, in the order of shapes().bones.
  const std::vector<TriangleMesh>& bones() const { return maker_->bones(); }

 private:
  void take_tissue(std::size_t muscle);
  void fill_forces(int number, ShownFrame& frame) const;
  void work();
  ShownFrame read(int frame);
  int frame_without_depth() const;

  const RecordedRun& run_;
  ShapeHistory& history_;
  const CaptionedFrames captions_;
  ShownShapes shapes_;
  std::optional<FrameMaker> maker_;
  std::vector<bool> has_depth_;  ///< per frame
  Eigen::MatrixXd activations_, volumes_, milliseconds_;
  std::vector<Eigen::MatrixXd> tensions_;  ///< per muscle: frames × fibers, N
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace gracilis
