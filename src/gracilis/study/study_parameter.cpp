#include <gracilis/study/study_parameter.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gracilis {

static std::string text_of_value(const toml::node& node) {
  if (node.is_string()) return node.as_string()->get();
  if (node.is_boolean()) return node.as_boolean()->get() ? "true" : "false";
  if (node.is_integer()) return fmt::format("{}", node.as_integer()->get());
  if (node.is_floating_point() && std::isfinite(node.as_floating_point()->get()))
    return fmt::format("{}", node.as_floating_point()->get());
  return "";
}

static std::vector<std::string> listed_values(TomlReader& reader) {
  const toml::node* node = reader.find("values");
  if (!node) return {};
  std::vector<std::string> values;
  if (const toml::array* array = node->as_array())
    for (const toml::node& element : *array) values.push_back(text_of_value(element));
  if (values.empty() || std::count(values.begin(), values.end(), "") > 0) {
    reader.add_problem("values", "'values' must be a list of numbers, texts, true or false");
    return {};
  }
  return values;
}

static bool read_scale(TomlReader& reader, StudyParameter& parameter) {
  const std::string scale = reader.text("scale").value_or("linear");
  parameter.logarithmic = scale == "log";
  if (scale != "linear" && scale != "log") {
    reader.add_problem("scale", "'scale' must be \"linear\" or \"log\"");
    return false;
  }
  if (parameter.logarithmic && parameter.low <= 0) {
    reader.add_problem("range", "a range by its logarithm must begin above 0");
    return false;
  }
  return true;
}

static bool read_range(TomlReader& reader, SamplingKind kind, StudyParameter& parameter) {
  const std::optional<Eigen::Vector2d> range = reader.pair("range");
  if (!range) return false;
  parameter.low = range->x();
  parameter.high = range->y();
  parameter.whole = reader.flag("whole").value_or(false);
  if (!(parameter.low < parameter.high)) {
    reader.add_problem("range", "'range' must begin below its end");
    return false;
  }
  if (parameter.whole && std::floor(parameter.high) < std::ceil(parameter.low)) {
    reader.add_problem("range", "there is no whole number in the range");
    return false;
  }
  if (kind == SamplingKind::grid) {
    if (!reader.has("steps"))
      reader.add_problem("range", "a range in a grid needs 'steps'", "say how many values it has");
    const std::optional<Index> steps = reader.integer("steps", 1, 1'000'000);
    if (!steps) return false;
    parameter.steps = *steps;
  }
  return read_scale(reader, parameter);
}

std::optional<StudyParameter> read_parameter(TomlReader reader, SamplingKind kind, std::vector<Problem>& problems) {
  const std::size_t before = problems.size();
  StudyParameter parameter;
  parameter.key = reader.required_text("key");
  if (parameter.key.find('=') != std::string::npos)
    reader.add_problem("key", "'key' is what stands before the = of --set", "name the values in 'values' or 'range'");
  parameter.values = listed_values(reader);
  const bool has_range = reader.has("range"), has_values = reader.has("values");
  if (has_range && has_values) {
    reader.add_problem("range", "a parameter has 'values' or a 'range', not both");
  } else if (has_range && kind == SamplingKind::list) {
    reader.add_problem("range", "a list needs 'values'", "choose another kind in [sampling] for a range");
  } else if (has_range) {
    read_range(reader, kind, parameter);
  } else if (!has_values) {
    reader.add_problem("key",
                       "a parameter needs 'values'" + std::string(kind == SamplingKind::list ? "" : " or a 'range'"));
  }
  if (has_values) parameter.steps = static_cast<Index>(parameter.values.size());
  reader.reject_unknown_keys();
  if (problems.size() > before) return std::nullopt;
  return parameter;
}

std::string value_at(const StudyParameter& parameter, Real place) {
  if (!parameter.values.empty()) {
    const auto count = static_cast<Real>(parameter.values.size());
    return parameter.values[static_cast<std::size_t>(std::min(std::floor(place * count), count - 1))];
  }
  if (parameter.whole) {
    const Real low = std::ceil(parameter.low), high = std::floor(parameter.high);
    if (!parameter.logarithmic)
      return fmt::format("{:.0f}", std::min(low + std::floor(place * (high - low + 1)), high));
    return fmt::format("{:.0f}", std::round(low * std::pow(high / low, place)));
  }
  const Real value = place <= 0              ? parameter.low
                     : place >= 1            ? parameter.high
                     : parameter.logarithmic ? parameter.low * std::pow(parameter.high / parameter.low, place)
                                             : parameter.low + place * (parameter.high - parameter.low);
  return fmt::format("{}", value);
}

}  // namespace gracilis
