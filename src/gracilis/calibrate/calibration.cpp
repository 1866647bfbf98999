#include <gracilis/calibrate/calibration.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gracilis {

std::string setting_text(const CalibrationParameter& parameter, Real place) {
  // Nine digits: finer than any setting is known, and short where people wrote short ones.
  if (place <= 0 || place >= 1 || parameter.setting.whole)
    return value_at(parameter.setting, std::clamp<Real>(place, 0, 1));
  return fmt::format("{:.9g}", std::stod(value_at(parameter.setting, place)));
}

Real setting_value(const CalibrationParameter& parameter, Real place) {
  return std::stod(setting_text(parameter, place));
}

Real place_of_value(const CalibrationParameter& parameter, Real value) {
  const StudyParameter& setting = parameter.setting;
  const Real within = std::clamp(value, setting.low, setting.high);
  if (setting.logarithmic) return std::log(within / setting.low) / std::log(setting.high / setting.low);
  return (within - setting.low) / (setting.high - setting.low);
}

std::string words_of(TargetKind kind) {
  return kind == TargetKind::moment_arms ? "moment arms"
                                         : std::string(choices_of(kind)[static_cast<std::size_t>(kind)]);
}

std::string shown_unit(TargetKind kind) { return kind == TargetKind::volumes ? "cm3" : "mm"; }

Real shown_factor(TargetKind kind) { return kind == TargetKind::volumes ? 1e6 : 1e3; }

std::vector<CalibrationTarget> targets_that(const Calibration& calibration, bool held_out) {
  std::vector<CalibrationTarget> chosen;
  for (const CalibrationTarget& target : calibration.targets)
    if (target.held_out == held_out) chosen.push_back(target);
  return chosen;
}

std::vector<Real> differences(const CalibrationTarget& target, const TargetPart& part,
                              const std::vector<Real>& observed) {
  std::vector<Real> result = observed;
  Real mean = 0;
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (!part.shape) result[i] -= part.values[i];
    mean += result[i] / static_cast<Real>(result.size());
  }
  if (target.change)
    for (Real& each : result) each -= mean;
  return result;
}

Eigen::VectorXd residuals(const std::vector<CalibrationTarget>& targets, const Observation& observed) {
  std::vector<Real> all;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const std::size_t begin = all.size();
    for (std::size_t p = 0; p < targets[t].parts.size(); ++p) {
      const std::vector<Real> part = differences(targets[t], targets[t].parts[p], observed[t][p]);
      all.insert(all.end(), part.begin(), part.end());
    }
    const auto count = static_cast<Real>(all.size() - begin);
    const Real factor = std::sqrt(targets[t].weight / count) / targets[t].tolerance;
    for (std::size_t i = begin; i < all.size(); ++i) all[i] *= factor;
  }
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Index>(all.size()));
}

static Real root_mean_square(Real squares, std::size_t count) {
  return count == 0 ? 0 : std::sqrt(squares / static_cast<Real>(count));
}

Real part_rms(const CalibrationTarget& target, const TargetPart& part, const std::vector<Real>& observed) {
  Real squares = 0;
  for (const Real each : differences(target, part, observed)) squares += each * each;
  return root_mean_square(squares, observed.size());
}

Real target_rms(const CalibrationTarget& target, const std::vector<std::vector<Real>>& observed) {
  Real squares = 0;
  std::size_t count = 0;
  for (std::size_t p = 0; p < target.parts.size(); ++p) {
    const Real rms = part_rms(target, target.parts[p], observed[p]);
    squares += rms * rms * static_cast<Real>(observed[p].size());
    count += observed[p].size();
  }
  return root_mean_square(squares, count);
}

}  // namespace gracilis
