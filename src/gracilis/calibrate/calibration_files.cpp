#include <gracilis/calibrate/calibration_files.hpp>

#include <gracilis/core/quoted_text.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/scene/scene_layers.hpp>
#include <gracilis/io/text_cells.hpp>
#include <gracilis/io/value_reader.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gracilis {

namespace fs = std::filesystem;

ParameterEstimate estimate_of(const CalibrationResult& result, std::size_t parameter) {
  constexpr Real of_95_percent = 1.96;
  const auto p = static_cast<Index>(parameter);
  const CalibrationParameter& known = result.calibration.parameters[parameter];
  const StudyParameter& setting = known.setting;
  const Real place = result.best[p], error = result.uncertainty.errors[p];
  ParameterEstimate estimate;
  estimate.value = setting_value(known, place);
  const Real slope =
      setting.logarithmic ? estimate.value * std::log(setting.high / setting.low) : setting.high - setting.low;
  estimate.error = slope * error;
  estimate.from = std::isnan(error) ? error : setting_value(known, place - of_95_percent * error);
  estimate.to = std::isnan(error) ? error : setting_value(known, place + of_95_percent * error);
  return estimate;
}

namespace {

/// What `--set` takes as a TOML value: a bare word is a text.
std::string toml_value(const std::string& text) {
  double number = 0;
  const bool is_whole = text == "true" || text == "false" || text.starts_with('[') || text.starts_with('"');
  return is_whole || parse_number(text, number) ? text : quoted_text(text);
}

/// Settings by the table that they stand in, in the order in which they were named; a later one replaces an earlier
/// one.
class SettingTables {
 public:
  void add(const std::string& word) {
    const std::size_t equals = word.find('=');
    const std::string key = word.substr(0, equals), value = toml_value(word.substr(equals + 1));
    const std::size_t dot = key.rfind('.');
    const bool is_top = key == "preset" || key == "method";
    const std::string owner = is_top ? "" : dot == std::string::npos ? "settings" : key.substr(0, dot);
    if (owner == "motion") return;  // a scene's motion is its own
    Named<std::string>& table = entry(tables_, owner, {});
    entry(table, key.substr(dot == std::string::npos ? 0 : dot + 1), std::string()) = value;
  }

  std::string text() const {
    std::string top, tables, muscles;
    for (const auto& [owner, entries] : tables_) {
      std::string lines;
      for (const auto& [key, value] : entries) lines += key + " = " + value + "\n";
      if (owner.empty())
        top += lines;
      else if (is_setting_section(owner))
        tables += "\n[" + owner + "]\n" + lines;
      else
        muscles += "\n[[muscles]]\nname = " + quoted_text(owner) + "\n[muscles.settings]\n" + lines;
    }
    return top + tables + muscles;
  }

 private:
  template <class Value>
  using Named = std::vector<std::pair<std::string, Value>>;

  template <class Value>
  static Value& entry(Named<Value>& all, const std::string& name, const Value& usual) {
    for (auto& [key, value] : all)
      if (key == name) return value;
    return all.emplace_back(name, usual).second;
  }

  Named<Named<std::string>> tables_;
};

void write_scene(const fs::path& folder, const CalibratedScene& scene) {
  std::error_code error;
  fs::path from = fs::relative(scene.file, folder, error);
  if (error || from.empty()) from = fs::absolute(scene.file);
  std::string text = "# The scene with what 'gracilis calibrate' found.\nschema = 1\nname = " +
                     quoted_text(scene.file.stem().string() + "_calibrated") + "\ninclude = [" +
                     quoted_text(from.generic_string()) + ", \"calibrated.toml\"]\n";
  if (!scene.only.empty()) {
    text += "only = [";
    for (std::size_t i = 0; i < scene.only.size(); ++i) text += (i > 0 ? ", " : "") + quoted_text(scene.only[i]);
    text += "]\n";
  }
  write_text_atomically(folder / "calibrated_scene.toml", text);
}

/// Behind the point; empty where it is not known.
std::string four_digits(Real value) { return std::isnan(value) ? "" : fmt::format("{:.4f}", value); }

std::string number_or_nothing(Real value) { return std::isnan(value) ? "" : fmt::format("{:.6g}", value); }

void write_parameters(const fs::path& file, const CalibrationResult& result) {
  std::string text = "parameter,start,calibrated,low,high,scale,standard_error,from_95,to_95,remark\n";
  for (std::size_t p = 0; p < result.calibration.parameters.size(); ++p) {
    const StudyParameter& setting = result.calibration.parameters[p].setting;
    const ParameterEstimate estimate = estimate_of(result, p);
    text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", csv_cell(setting.key), result.start_values[p],
                        result.best_values[p], setting.low, setting.high, setting.logarithmic ? "log" : "linear",
                        number_or_nothing(estimate.error), number_or_nothing(estimate.from),
                        number_or_nothing(estimate.to), csv_cell(result.uncertainty.remarks[p]));
  }
  write_text_atomically(file, text);
}

void write_fit(const fs::path& file, const CalibrationResult& result) {
  std::string text = "target,held_out,muscle,source,angle_deg,aim,before,after,unit,remark\n";
  for (std::size_t t = 0; t < result.calibration.targets.size(); ++t) {
    const CalibrationTarget& target = result.calibration.targets[t];
    const Real factor = shown_factor(target.kind);
    for (std::size_t p = 0; p < target.parts.size(); ++p) {
      const TargetPart& part = target.parts[p];
      const std::string begin = fmt::format("{},{},{},{}", csv_cell(target.name), target.held_out ? "yes" : "no",
                                            csv_cell(part.muscle), csv_cell(part.source));
      const std::string end = fmt::format("{},{}\n", shown_unit(target.kind), csv_cell(result.remarks[t]));
      const std::vector<Real>&before = result.before[t][p], &after = result.after[t][p];
      if (part.shape)
        text += fmt::format("{},,0,{},{},{}", begin, four_digits(factor * part_rms(target, part, before)),
                            four_digits(factor * part_rms(target, part, after)), end);
      for (std::size_t i = 0; i < part.values.size(); ++i)
        text += fmt::format("{},{},{:.4f},{},{},{}", begin,
                            part.at.empty() ? "" : fmt::format("{:.4f}", degrees(part.at[i])), factor * part.values[i],
                            four_digits(factor * before[i]), four_digits(factor * after[i]), end);
    }
  }
  write_text_atomically(file, text);
}

}  // namespace

std::string calibrated_toml(const CalibrationResult& result, const std::vector<std::string>& set) {
  SettingTables tables;
  for (const std::string& word : set) tables.add(word);
  for (std::size_t p = 0; p < result.best_values.size(); ++p)
    tables.add(result.calibration.parameters[p].setting.key + "=" + result.best_values[p]);
  return "# Found by 'gracilis calibrate'. A scene takes it by include = [..., \"calibrated.toml\"], after what it is "
         "to "
         "change.\n" +
         tables.text();
}

void write_calibration_files(const fs::path& folder, const CalibrationResult& result, const CalibratedScene& scene) {
  write_text_atomically(folder / "calibrated.toml", calibrated_toml(result, scene.set));
  if (!scene.file.empty()) write_scene(folder, scene);
  write_parameters(folder / "parameters.csv", result);
  write_fit(folder / "fit.csv", result);
}

}  // namespace gracilis
