#pragma once

#include <gracilis/methods/method_entry.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/simulate/run.hpp>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <utility>
#include <vector>

namespace gracilis {

/// What became of the gates and of constraints that could not do their work, over the frames of a run.
class SessionSummary {
 public:
  /// `scene` must outlive it; `level` is what the run measures.
  SessionSummary(const Scene& scene, MeasureLevel level);

  /// The next frame, with its measures.
  void add(const FrameRecord& record);

  bool all_gates_met() const { return missed_muscles() == 0; }  ///< by every muscle in every frame so far
  /// "gates: ...", one line.
  std::string gates_line() const;
  /// The frame and muscle farthest beyond a gate, and why that matters; empty where all are met.
  std::string worst_line() const;
  /// Per muscle that misses gates: in how many frames, and what it missed first.
  std::vector<std::string> missed_lines() const;
  /// All of it for programs: whether gates are met, how many muscles and frames miss some, what was not measured; the
  /// worst, null where all are met; and the muscles that miss gates with the reason first met.
  nlohmann::ordered_json as_json() const;
  /// Per muscle, what constraints could not do, as in "3 projections skipped"; without those where nothing happened.
  std::vector<std::pair<std::string, std::string>> counters() const;

 private:
  struct PerMuscle {
    int frames_missed = 0;
    int first_missed = 0;
    std::string first_reason;
    std::vector<Real> sums;  ///< of the method's metrics, in their order
  };
  int missed_muscles() const;
  std::string trouble_of(const PerMuscle& muscle) const;

  const Scene& scene_;
  MeasureLevel level_;
  std::vector<MetricInfo> metrics_;
  std::vector<PerMuscle> muscles_;
  int frames_ = 0, frames_missed_ = 0;
  int worst_frame_ = 0;
  std::size_t worst_muscle_ = 0;
  MissedGate worst_{"", "", 0};
};

}  // namespace gracilis
