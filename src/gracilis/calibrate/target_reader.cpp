#include <gracilis/calibrate/target_reader.hpp>

#include <gracilis/calibrate/target_files.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/parse_toml.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/toml_reader.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace gracilis {

namespace fs = std::filesystem;

/// One of the values' names, whose number is the value.
template <class Choice>
static std::optional<Choice> read_choice(TomlReader& reader, const std::string& key, Choice usual) {
  const std::optional<std::string> name = reader.text(key);
  if (!name) return reader.has(key) ? std::nullopt : std::optional(usual);
  const auto names = choices_of(usual);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == *name) return static_cast<Choice>(i);
  reader.add_problem(key, "there is no " + key + " '" + *name + "'", suggestion(*name, {names.begin(), names.end()}));
  return std::nullopt;
}

static void read_pose(TomlReader& reader, CalibrationTarget& target) {
  const toml::node* node = reader.find("pose");
  if (!node) return;
  const toml::table* table = node->as_table();
  if (!table) return reader.add_problem("pose", "'pose' must be a table", "as in pose = { hip_flexion_r = 30 }");
  for (const auto& [key, value] : *table) {
    const std::optional<Real> number = value.is_number() ? value.value<Real>() : std::nullopt;
    if (number && std::isfinite(*number))
      target.pose[std::string(key.str())] = *number;
    else
      reader.add_problem(value, "'" + std::string(key.str()) + "' must be a number", "degrees, or mm of a translation");
  }
}

/// What the scene calls muscles that the file has other names for.
static void read_names(TomlReader& reader, CurveChoice& choice) {
  const toml::node* node = reader.find("names");
  if (!node) return;
  const toml::table* table = node->as_table();
  if (!table)
    return reader.add_problem("names", "'names' must be a table", "as in names = { psoas_r = \"psoas_major_r\" }");
  for (const auto& [key, value] : *table) {
    if (value.is_string())
      choice.names[std::string(key.str())] = value.as_string()->get();
    else
      reader.add_problem(value, "'" + std::string(key.str()) + "' must be a text in quotes",
                         "the muscle's name in the scene");
  }
}

/// What of a table of curves is wanted.
static CurveChoice read_curve_choice(TomlReader& reader) {
  CurveChoice choice;
  choice.muscles = reader.texts("muscles");
  choice.sources = reader.texts("sources");
  read_names(reader, choice);
  if (const std::optional<Eigen::Vector2d> range = reader.pair("range")) {
    if (!(range->x() < range->y())) {
      reader.add_problem("range", "'range' must begin below its end");
    } else {
      choice.from = radians(range->x());
      choice.to = radians(range->y());
    }
  }
  choice.spacing = radians(reader.number("spacing", {0, 360, "degrees"}).value_or(2));
  return choice;
}

static void read_curves(TomlReader& reader, const TargetFiles& files, CalibrationTarget& target) {
  target.coordinate = reader.required_text("coordinate");
  const CurveChoice choice = read_curve_choice(reader);
  target.names_muscles = choice.muscles.empty();
  if (target.kind == TargetKind::lengths) target.change = reader.flag("change").value_or(false);
  const std::string file = reader.required_text("file");
  if (file.empty() || target.coordinate.empty()) return;
  if (target.pose.contains(target.coordinate))
    reader.add_problem("pose", "'" + target.coordinate + "' is what moves", "name other coordinates in 'pose'");
  files.read_curves(reader, file, choice, target);
}

static void read_volumes(TomlReader& reader, const TargetFiles& files, CalibrationTarget& target) {
  const toml::node* node = reader.find("volumes_cm3");
  if (reader.has("file") == (node != nullptr))
    return reader.add_problem("kind", "volumes need either 'volumes_cm3' or 'file'",
                              "volumes_cm3 = { psoas_r = 103 }, or a .csv with the columns muscle and volume_cm3");
  if (!node) {
    target.names_muscles = true;
    return files.read_volumes(reader, reader.required_text("file"), target);
  }
  const toml::table* table = node->as_table();
  if (!table)
    return reader.add_problem("volumes_cm3", "'volumes_cm3' must be a table", "as in volumes_cm3 = { psoas_r = 103 }");
  for (const auto& [key, value] : *table) {
    const std::optional<Real> number = value.is_number() ? value.value<Real>() : std::nullopt;
    if (number && std::isfinite(*number) && *number > 0)
      target.parts.push_back({std::string(key.str()), "", {}, {1e-6 * *number}});
    else
      reader.add_problem(value, "'" + std::string(key.str()) + "' must be a number above 0", "cm³");
  }
}

static void read_target(TomlReader& reader, const TargetFiles& files, Calibration& calibration) {
  CalibrationTarget target;
  target.place = reader.place();
  if (!reader.has("kind"))
    return reader.add_problem("kind", "[[targets]] needs the key 'kind'", "moment_arms, lengths, volumes or shapes");
  const std::optional<TargetKind> kind = read_choice(reader, "kind", TargetKind::moment_arms);
  if (!kind) return;
  target.kind = *kind;
  target.name = reader.text("name").value_or(fmt::format("{} {}", words_of(*kind), calibration.targets.size() + 1));
  target.weight = reader.number("weight", {0, 1e9}).value_or(1);
  const Real factor = 1 / shown_factor(*kind);
  target.tolerance = factor * reader.number("tolerance", {1e-6, 1e6, shown_unit(*kind)}).value_or(1);
  target.held_out = reader.flag("held_out").value_or(false);
  read_pose(reader, target);
  if (is_curve(*kind))
    read_curves(reader, files, target);
  else if (*kind == TargetKind::volumes)
    read_volumes(reader, files, target);
  else
    files.read_shape(reader, reader.required_text("muscle"), reader.required_text("file"), target);
  reader.reject_unknown_keys();
  calibration.targets.push_back(std::move(target));
}

static void read_calibrated(TomlReader& reader, std::vector<CalibrationParameter>& parameters) {
  CalibrationParameter parameter;
  StudyParameter& setting = parameter.setting;
  parameter.place = reader.place();
  setting.key = reader.required_text("key");
  if (setting.key.find('=') != std::string::npos)
    reader.add_problem("key", "'key' is what stands before the = of --set", "name its bounds in 'bounds'");
  if (!reader.has("bounds"))
    reader.add_problem("key", "[[parameters]] needs the key 'bounds'", "as in bounds = [1, 50]");
  const std::string scale = reader.text("scale").value_or("linear");
  setting.logarithmic = scale == "log";
  if (scale != "linear" && scale != "log") reader.add_problem("scale", "'scale' must be \"linear\" or \"log\"");
  parameter.start = reader.number("start");
  if (const std::optional<Eigen::Vector2d> bounds = reader.pair("bounds")) {
    setting.low = bounds->x();
    setting.high = bounds->y();
    if (!(setting.low < setting.high))
      reader.add_problem("bounds", "'bounds' must begin below their end");
    else if (setting.logarithmic && setting.low <= 0)
      reader.add_problem("bounds", "bounds of a logarithmic scale must begin above 0");
    else if (parameter.start && !(*parameter.start >= setting.low && *parameter.start <= setting.high))
      reader.add_problem("start", fmt::format("'start' lies outside of the bounds {} to {}", setting.low, setting.high),
                         "begin within them, or widen them");
  }
  reader.reject_unknown_keys();
  parameters.push_back(std::move(parameter));
}

static void read_search(TomlReader& reader, CalibrationSearch& search) {
  search.method = read_choice(reader, "method", SearchMethod::least_squares).value_or(search.method);
  search.samples = reader.integer("samples", 0, 100'000).value_or(0);
  const std::string sampling = reader.text("sampling").value_or("sobol");
  if (sampling == "latin")
    search.sampling = SamplingKind::latin;
  else if (sampling == "halton")
    search.sampling = SamplingKind::halton;
  else if (sampling != "sobol")
    reader.add_problem("sampling", "there is no sampling '" + sampling + "'",
                       suggestion(sampling, {"sobol", "halton", "latin"}));
  search.seed = static_cast<std::uint64_t>(reader.integer("seed", 0, std::numeric_limits<Index>::max()).value_or(1));
  search.evaluations = reader.integer("evaluations", 1, 1'000'000).value_or(200);
  search.difference = reader.number("difference", {1e-6, 0.5}).value_or(search.difference);
  search.stop = reader.number("stop", {1e-12, 1}).value_or(search.stop);
  reader.reject_unknown_keys();
}

static void read_description(TomlReader& top, const TargetFiles& files, Calibration& calibration) {
  for (TomlReader& each : top.tables("targets")) read_target(each, files, calibration);
  for (TomlReader& each : top.tables("parameters")) read_calibrated(each, calibration.parameters);
  if (std::optional<TomlReader> search = top.table("search")) read_search(*search, calibration.search);
  if (!top.has("targets")) top.add_problem("targets", "there is nothing to aim at", "add [[targets]]");
  if (!top.has("parameters")) top.add_problem("parameters", "there is nothing to change", "add [[parameters]]");
  top.reject_unknown_keys();
  std::set<std::string> keys, names;
  for (const CalibrationParameter& each : calibration.parameters) {
    Problem problem = each.place;
    problem.what = "there are two parameters '" + each.setting.key + "'";
    problem.remedy = "remove one";
    if (!each.setting.key.empty() && !keys.insert(each.setting.key).second) top.add_problem(problem);
  }
  for (const CalibrationTarget& each : calibration.targets) {
    Problem problem = each.place;
    problem.what = "there are two targets '" + each.name + "'";
    problem.remedy = "give one another 'name'";
    if (!names.insert(each.name).second) top.add_problem(problem);
  }
  if (!calibration.targets.empty() && targets_that(calibration, false).empty())
    top.add_problem("targets", "all targets are held out", "leave one without 'held_out'");
  const auto count = static_cast<Index>(calibration.parameters.size());
  if (calibration.search.samples > 0 && count > most_columns(calibration.search.sampling))
    top.add_problem("search",
                    fmt::format("this sampling knows at most {} parameters", most_columns(calibration.search.sampling)),
                    "latin knows any number");
  if (calibration.search.method == SearchMethod::bobyqa && count == 1)
    top.add_problem("search", "bobyqa needs two parameters", "sbplx, cobyla and least-squares take one");
}

Calibration read_targets(const fs::path& file, const fs::path& data) {
  Calibration calibration;
  calibration.file = file;
  calibration.inputs = {file};
  const toml::table table = parse_written_toml(read_text(file), file.string());
  std::vector<Problem> problems, of_files;
  TomlReader top(table, "the targets file", problems);
  read_description(top, TargetFiles(file, data, calibration.inputs, of_files), calibration);
  sort_by_place(problems);
  if (problems.empty() && !of_files.empty()) throw InputError(of_files);
  problems.insert(problems.end(), of_files.begin(), of_files.end());
  if (!problems.empty()) throw ConfigurationError(problems);
  return calibration;
}

}  // namespace gracilis
