#include <gracilis/view/session/session_summary.hpp>

#include <gracilis/methods/registry.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace gracilis {

SessionSummary::SessionSummary(const Scene& scene, MeasureLevel level)
    : scene_(scene), level_(level), metrics_(method_of(scene).metrics), muscles_(scene.muscles.size()) {}

void SessionSummary::add(const FrameRecord& record) {
  ++frames_;
  bool any_missed = false;
  for (std::size_t m = 0; m < std::min(muscles_.size(), record.measures.size()); ++m) {
    const std::vector<MissedGate> missed = gates_missed_by(record.measures[m], QualityGates{});
    any_missed |= !missed.empty();
    if (!missed.empty() && muscles_[m].frames_missed++ == 0) {
      muscles_[m].first_missed = record.frame.number;
      muscles_[m].first_reason = fmt::format("{}", fmt::join(missed_gates(record.measures[m], QualityGates{}), "; "));
    }
    for (const MissedGate& gate : missed) {
      if (!(gate.excess > worst_.excess)) continue;
      worst_ = gate;
      worst_frame_ = record.frame.number;
      worst_muscle_ = m;
    }
    if (m >= record.report.muscles.size()) continue;
    muscles_[m].sums.resize(metrics_.size());
    for (std::size_t k = 0; k < metrics_.size(); ++k)
      muscles_[m].sums[k] += metric(record.report.muscles[m].metrics, metrics_[k].name);
  }
  frames_missed_ += any_missed;
}

int SessionSummary::missed_muscles() const {
  return static_cast<int>(
      std::count_if(muscles_.begin(), muscles_.end(), [](const PerMuscle& m) { return m.frames_missed > 0; }));
}

std::string SessionSummary::gates_line() const {
  const std::vector<std::string> unmeasured = unmeasured_gates(level_);
  const std::string not_measured =
      unmeasured.empty() ? "" : fmt::format("; not measured: {}", fmt::join(unmeasured, ", "));
  if (level_ == MeasureLevel::none) return "gates:" + not_measured.substr(1);
  if (all_gates_met())
    return fmt::format("gates: met by all muscles ({}) in all frames ({}){}", muscles_.size(), frames_, not_measured);
  return fmt::format("gates: missed by {} of {} muscles, in {} of {} frames{}", missed_muscles(), muscles_.size(),
                     frames_missed_, frames_, not_measured);
}

std::string SessionSummary::worst_line() const {
  if (all_gates_met()) return "";
  return fmt::format("worst: frame {}, {}: {}: {}", worst_frame_, scene_.muscles[worst_muscle_].name, worst_.text,
                     worst_.consequence);
}

std::vector<std::string> SessionSummary::missed_lines() const {
  std::vector<std::string> lines;
  for (std::size_t m = 0; m < muscles_.size(); ++m)
    if (muscles_[m].frames_missed > 0)
      lines.push_back(fmt::format("{} misses quality gates in {} frames, first in frame {}: {}", scene_.muscles[m].name,
                                  muscles_[m].frames_missed, muscles_[m].first_missed, muscles_[m].first_reason));
  return lines;
}

nlohmann::ordered_json SessionSummary::as_json() const {
  nlohmann::ordered_json muscles = nlohmann::json::array(), worst;
  for (std::size_t m = 0; m < muscles_.size(); ++m)
    if (muscles_[m].frames_missed > 0)
      muscles.push_back({{"muscle", scene_.muscles[m].name},
                         {"frames", muscles_[m].frames_missed},
                         {"first_frame", muscles_[m].first_missed},
                         {"reason", muscles_[m].first_reason}});
  if (!all_gates_met())
    worst = {{"frame", worst_frame_},
             {"muscle", scene_.muscles[worst_muscle_].name},
             {"gate", worst_.text},
             {"consequence", worst_.consequence}};
  return {{"met", all_gates_met()}, {"frames", frames_missed_},
          {"of_frames", frames_},   {"not_measured", unmeasured_gates(level_)},
          {"worst", worst},         {"missed_by", muscles}};
}

std::string SessionSummary::trouble_of(const PerMuscle& muscle) const {
  std::string text;
  bool any = false;
  for (std::size_t k = 0; k < muscle.sums.size(); ++k) {
    if (metrics_[k].trouble.empty()) continue;
    text += fmt::format("{}{:.0f} {}", text.empty() ? "" : ", ", muscle.sums[k], metrics_[k].trouble);
    any |= muscle.sums[k] > 0;
  }
  return any ? text : "";
}

std::vector<std::pair<std::string, std::string>> SessionSummary::counters() const {
  std::vector<std::pair<std::string, std::string>> all;
  for (std::size_t m = 0; m < muscles_.size(); ++m)
    if (std::string trouble = trouble_of(muscles_[m]); !trouble.empty())
      all.emplace_back(scene_.muscles[m].name, std::move(trouble));
  return all;
}

}  // namespace gracilis
