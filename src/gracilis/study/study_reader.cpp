#include <gracilis/study/study_reader.hpp>

#include <gracilis/io/input_file.hpp>
#include <gracilis/io/parse_toml.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/toml_reader.hpp>
#include <gracilis/study/run_table.hpp>
#include <gracilis/study/study_parameter.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <set>

namespace gracilis {

namespace fs = std::filesystem;

/// Runs record paths of their files, which have to be found again from whatever folder one asks about them.
static fs::path from_anywhere(const fs::path& path) { return fs::absolute(path).lexically_normal(); }

/// The data folder that the environment names, where it is named from the folder that one stands in.
static fs::path relative_data_root() {
  const char* variable = std::getenv("GRACILIS_DATA");
  std::error_code ignored;
  const bool is_relative = variable && *variable && fs::path(variable).is_relative();
  return is_relative && fs::is_directory(variable, ignored) ? from_anywhere(variable) : fs::path();
}

static std::vector<std::string> names_of_samplings() {
  std::vector<std::string> names = {"table"};
  for (const SamplingName& each : sampling_names) names.emplace_back(each.name);
  return names;
}

static void read_recording(TomlReader& top, StudyRecording& recording) {
  if (const auto level = measure_level_called(top.text("metrics").value_or("full")))
    recording.measures = *level;
  else
    top.add_problem("metrics", "'metrics' must be \"none\", \"light\" or \"full\"");
  recording.fibers = top.flag("fibers").value_or(true);
  recording.ramps = top.flag("ramps").value_or(true);
  recording.arms = top.flag("arms").value_or(false);
  recording.pictures = top.flag("pictures").value_or(false);
  recording.every = static_cast<int>(top.integer("every", 1, 1'000'000).value_or(1));
  if (const auto layout = run_layout_called(top.text("layout").value_or("compact")))
    recording.layout = *layout;
  else
    top.add_problem("layout", "'layout' must be \"compact\" or \"surfaces\"");
}

/// The table that lists runs, where the sampling says so.
static std::string read_sampling(TomlReader& reader, Sampling& sampling) {
  const std::string kind = reader.required_text("kind");
  std::string table;
  const auto* found = std::find_if(sampling_names.begin(), sampling_names.end(),
                                   [&](const SamplingName& each) { return each.name == kind; });
  if (found != sampling_names.end())
    sampling.kind = found->kind;
  else if (kind == "table")
    table = reader.required_text("file");
  else if (!kind.empty())
    reader.add_problem("kind", "there is no sampling '" + kind + "'", suggestion(kind, names_of_samplings()));
  const bool has_samples = found != sampling_names.end() && kind != "list" && kind != "grid";
  if (has_samples && !reader.has("samples")) reader.add_problem("kind", "a sampling '" + kind + "' needs 'samples'");
  if (has_samples) sampling.samples = reader.integer("samples", 1, most_study_runs).value_or(1);
  if (kind == "latin" || kind == "morris") {
    if (const std::optional<Index> seed = reader.integer("seed", 0, std::numeric_limits<Index>::max()))
      sampling.seeds = {static_cast<std::uint64_t>(*seed)};
    if (reader.has("seeds")) {
      sampling.seeds.clear();
      for (const Index seed : reader.indices("seeds")) sampling.seeds.push_back(static_cast<std::uint64_t>(seed));
      if (reader.has("seed")) reader.add_problem("seed", "'seed' and 'seeds' exclude each other");
    }
  }
  if (kind == "morris") {
    sampling.levels = reader.integer("levels", 2, 1000).value_or(4);
    if (sampling.levels % 2 != 0) reader.add_problem("levels", "'levels' must be even");
  }
  reader.reject_unknown_keys();
  return table;
}

static std::vector<StudyOutcome> read_outcomes(TomlReader& top) {
  using Statistic = StudyOutcome::Statistic;
  std::vector<StudyOutcome> outcomes;
  for (TomlReader& each : top.tables("outcomes")) {
    StudyOutcome outcome{each.required_text("metric"), each.text("muscle").value_or(""), Statistic::largest};
    const std::string name = each.text("statistic").value_or("largest");
    bool is_known = false;
    for (const Statistic one : {Statistic::largest, Statistic::smallest, Statistic::mean, Statistic::last})
      if (name == name_of(one)) outcome.statistic = one, is_known = true;
    if (!is_known)
      each.add_problem("statistic", "there is no statistic '" + name + "'",
                       suggestion(name, {"largest", "smallest", "mean", "last"}));
    each.reject_unknown_keys();
    outcomes.push_back(std::move(outcome));
  }
  return outcomes;
}

static void add_runs(Study& study, const std::vector<StudyParameter>& parameters, const StudyRun& common,
                     TomlReader& top) {
  std::vector<Index> steps;
  std::vector<bool> in_parts;
  for (const StudyParameter& parameter : parameters) {
    steps.push_back(parameter.steps);
    in_parts.push_back(!parameter.values.empty());
  }
  const auto columns = static_cast<Index>(parameters.size());
  const bool is_list = study.sampling.kind == SamplingKind::list;
  if (is_list && std::set<Index>(steps.begin(), steps.end()).size() > 1) {
    top.add_problem("parameters", "the parameters of a list must have as many values as each other",
                    "choose kind = \"grid\" for every combination");
    return;
  }
  if (columns == 0 && study.sampling.samples > 0) {
    top.add_problem("sampling", "this sampling has no parameters to spread", "add [[parameters]]");
    return;
  }
  if (columns > most_columns(study.sampling.kind)) {
    top.add_problem("parameters",
                    fmt::format("this sampling knows at most {} parameters", most_columns(study.sampling.kind)),
                    "latin and morris know any number");
    return;
  }
  if (design_size(study.sampling, columns, steps) > Real(most_study_runs)) {
    top.add_problem("parameters", fmt::format("more than {} runs", most_study_runs), "take fewer steps or samples");
    return;
  }
  study.points = design_points(study.sampling, columns, steps, in_parts);
  const Index count = is_list ? (steps.empty() ? 1 : steps[0]) : study.points.rows();
  for (Index row = 0; row < count; ++row) {
    StudyRun run = common;
    run.name = run_name(row + 1);
    for (Index column = 0; column < columns; ++column) {
      const StudyParameter& parameter = parameters[static_cast<std::size_t>(column)];
      run.values.push_back(is_list ? parameter.values[static_cast<std::size_t>(row)]
                                   : value_at(parameter, study.points(row, column)));
      if (!give_value(run, parameter.key, run.values.back()))
        return top.add_problem("parameters", "'" + run.values.back() + "' is no flexion", "0 to 130 degrees");
    }
    study.runs.push_back(std::move(run));
  }
}

static std::vector<StudyParameter> read_parameters(TomlReader& top, SamplingKind kind, std::vector<Problem>& problems) {
  std::vector<StudyParameter> parameters;
  std::set<std::string> keys;
  for (const TomlReader& each : top.tables("parameters"))
    if (std::optional<StudyParameter> parameter = read_parameter(each, kind, problems)) {
      if (!keys.insert(parameter->key).second)
        top.add_problem("parameters", "there are two parameters '" + parameter->key + "'");
      parameters.push_back(std::move(*parameter));
    }
  return parameters;
}

static void read_description(TomlReader& top, Study& study, std::vector<Problem>& problems) {
  StudyRun common;
  common.scene = top.text("scene").value_or("");
  if (common.scene == "demo elbow") common.scene = "demo-elbow";
  common.flexion_deg = top.number("flexion", {0, 130, "degrees"});
  for (const std::string& word : top.texts("set")) {
    if (word.find('=') == std::string::npos) top.add_problem("set", "'" + word + "' is no KEY=VALUE");
    common.set.push_back(word);
  }
  if (const std::optional<std::string> out = top.text("out")) study.folder = study.file.parent_path() / *out;
  if (const std::optional<std::string> data = top.text("data"))
    study.data = from_anywhere(study.file.parent_path() / *data);
  study.only = top.texts("only");
  study.most_seconds = top.number("most_seconds", {0, 1e7, "s"}).value_or(0);
  read_recording(top, study.recording);
  study.outcomes = read_outcomes(top);
  std::string table;
  if (std::optional<TomlReader> sampling = top.table("sampling")) table = read_sampling(*sampling, study.sampling);
  std::vector<StudyParameter> parameters;
  if (table.empty())
    parameters = read_parameters(top, study.sampling.kind, problems);
  else if (top.has("parameters"))
    top.add_problem("parameters", "runs that a table lists have its columns as parameters");
  top.reject_unknown_keys();
  const bool names_scene =
      std::any_of(parameters.begin(), parameters.end(), [](const auto& p) { return p.key == "scene"; });
  if (common.scene.empty() && !names_scene && table.empty())
    top.add_problem("scene", "a study needs a 'scene'", "a scene file, \"demo\" or \"demo-elbow\"");
  if (!problems.empty()) return;
  if (!table.empty()) {
    StudyRun unnamed = common;
    read_run_table(study.file.parent_path() / table, common.scene, study);
    for (StudyRun& run : study.runs) {
      run.set.insert(run.set.begin(), unnamed.set.begin(), unnamed.set.end());
      if (!run.flexion_deg) run.flexion_deg = unnamed.flexion_deg;
    }
    return;
  }
  for (const StudyParameter& parameter : parameters) study.parameters.push_back(parameter.key);
  add_runs(study, parameters, common, top);
}

static void require_flexion_of_builtins(const Study& study, std::vector<Problem>& problems) {
  for (const StudyRun& run : study.runs)
    if (run.flexion_deg && !scene_file(study, run).empty()) {
      problems.push_back({study.file.string(), "run " + run.name, "only built-in scenes have a 'flexion'",
                          "the motion of a scene file is set by motion.KEY"});
      return;
    }
}

Study read_study(const fs::path& file) {
  Study study;
  study.file = file;
  study.folder = file.parent_path() / file.stem();
  std::vector<Problem> problems;
  if (lower_case_extension(file) == ".csv") {
    read_run_table(file, "", study);
  } else if (lower_case_extension(file) == ".toml") {
    const toml::table table = parse_written_toml(read_text(file), file.string());
    TomlReader top(table, "the study", problems);
    read_description(top, study, problems);
  } else {
    problems.push_back({file.string(), "", "is no study", "a study is a .toml or a .csv"});
  }
  if (problems.empty()) require_flexion_of_builtins(study, problems);
  if (problems.empty() && study.runs.empty())
    problems.push_back({file.string(), "", "has no runs", "name [[parameters]], or rows"});
  if (study.data.empty()) study.data = relative_data_root();
  sort_by_place(problems);
  if (!problems.empty()) throw ConfigurationError(problems);
  return study;
}

}  // namespace gracilis
