#include "activations_command.hpp"
#include "neighbors_command.hpp"

#include <gracilis/anatomy/joints/joint_control.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/json_file.hpp>
#include <gracilis/io/tables/activation_samples.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <memory>

namespace gracilis {

namespace {

namespace fs = std::filesystem;

struct JoinOptions {
  fs::path motions, results, out, mapping, forces;
  std::vector<std::pair<std::string, std::string>> pairs;
  std::vector<std::string> coordinates;
  bool json = false;
  JoinSettings settings;
};

/// The forces beside a result: the file itself, or that of the same name in the folder, "activation" read as "force".
fs::path forces_of(const fs::path& forces, const fs::path& result) {
  if (!fs::is_directory(forces)) return forces;
  fs::path same = forces / result.filename();
  std::string name = result.filename().string();
  const std::size_t word = name.rfind("activation");
  if (word == std::string::npos) return same;
  return forces / name.replace(word, std::string("activation").size(), "force");
}

std::vector<Trial> read_trials(const JoinOptions& options, std::vector<std::string>& problems) {
  std::vector<Trial> trials;
  for (const auto& [motion, result] : paired_files(options.motions, options.results, options.pairs, problems)) {
    Trial trial{result.filename().string(), read_table(motion), read_table(result), {}};
    if (options.settings.combine == CombineParts::weighted_mean)
      trial.forces = read_table(forces_of(options.forces, result));
    for (const Table* table : {&trial.motion, &trial.activations})
      for (const std::string& warning : table->warnings) spdlog::warn("{}", warning);
    trials.push_back(std::move(trial));
  }
  return trials;
}

/// Keeps these coordinates of the samples only.
void keep_coordinates(const std::vector<std::string>& coordinates, std::size_t all, Table& samples) {
  for (const std::string& name : coordinates) {
    const auto end = samples.columns.begin() + static_cast<std::ptrdiff_t>(all);
    if (std::find(samples.columns.begin(), end, name) == end)
      throw ConfigurationError({"--coord", "", "the motions have no coordinate '" + name + "'", ""});
  }
  std::vector<std::string> columns;
  Eigen::MatrixXd values(samples.values.rows(), 0);
  for (std::size_t i = 0; i < samples.columns.size(); ++i) {
    if (i < all && std::find(coordinates.begin(), coordinates.end(), samples.columns[i]) == coordinates.end()) continue;
    columns.push_back(samples.columns[i]);
    values.conservativeResize(Eigen::NoChange, values.cols() + 1);
    values.rightCols(1) = samples.values.col(static_cast<Eigen::Index>(i));
  }
  samples.columns = std::move(columns);
  samples.values = std::move(values);
}

void print_json(const Table& samples, std::size_t coordinates, const Eigen::VectorXd& errors) {
  const auto first_muscle = samples.columns.begin() + static_cast<std::ptrdiff_t>(coordinates);
  nlohmann::ordered_json by_muscle = nlohmann::json::object();
  for (Index i = 0; i < errors.size(); ++i) by_muscle[*(first_muscle + i)] = errors[i];
  fmt::print("{}", json_text({{"samples", samples.times.size()},
                              {"coordinates", std::vector<std::string>(samples.columns.begin(), first_muscle)},
                              {"left_out_rms", by_muscle}}));
}

/// How well the samples speak for each other.
void report(const Table& samples, std::size_t coordinates, bool as_json) {
  JointControlUnit unit;
  unit.angles = samples.values.leftCols(static_cast<Index>(coordinates)) * radians(1);
  unit.activations = samples.values.rightCols(samples.values.cols() - static_cast<Index>(coordinates));
  const Eigen::VectorXd errors = leave_out_error(unit);
  if (as_json) return print_json(samples, coordinates, errors);
  fmt::print("{} samples of {} coordinates and {} muscles\n", samples.times.size(), coordinates, errors.size());
  fmt::print("with every second sample left out, the others interpolate it to within (root mean square):\n");
  for (Index i = 0; i < errors.size(); ++i)
    fmt::print("  {}: {:.4f}\n", samples.columns[coordinates + static_cast<std::size_t>(i)], errors[i]);
}

int join(const JoinOptions& options) {
  JoinSettings settings = options.settings;
  if (settings.combine == CombineParts::weighted_mean && options.forces.empty())
    throw ConfigurationError(
        {"--combine", "", "a force-weighted mean needs the forces", "give --forces FILE or FOLDER"});
  if (!options.mapping.empty()) settings.muscles = read_muscle_mapping(options.mapping);
  std::vector<std::string> problems;
  const std::vector<Trial> trials = read_trials(options, problems);
  if (trials.empty())
    throw InputError({options.motions.string(), "", "no motion has results", "use --pair where names differ"});
  JoinedSamples joined = join_samples(trials, settings);
  problems.insert(problems.end(), joined.problems.begin(), joined.problems.end());
  for (const std::string& problem : problems) spdlog::warn("{}", problem);
  for (const std::string& note : joined.notes) spdlog::info("{}", note);
  const std::vector<std::string> known = motion_from_table(trials[0].motion).coordinates;
  std::size_t coordinates = 0;
  while (coordinates < joined.samples.columns.size() &&
         std::find(known.begin(), known.end(), joined.samples.columns[coordinates]) != known.end())
    ++coordinates;
  if (!options.coordinates.empty()) {
    keep_coordinates(options.coordinates, coordinates, joined.samples);
    coordinates = options.coordinates.size();
  }
  create_folder_of(options.out);
  write_sto(options.out, joined.samples);
  report(joined.samples, coordinates, options.json);
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_activations_command(CLI::App& program, Command& chosen) {
  CLI::App* command = program.add_subcommand("activations", "Samples of activations for joint control units");
  command->require_subcommand(1);
  CLI::App* joining = command->add_subcommand("join", "Join motions with results of static optimization by time");
  joining->footer("Example: gracilis activations join walks results --out joined.sto");
  const auto options = std::make_shared<JoinOptions>();
  joining->add_option("MOTIONS", options->motions, "Folder of .mot or .sto files with coordinates, or one file")
      ->required();
  joining->add_option("RESULTS", options->results, "Folder of .sto files with activations, or one file")->required();
  joining->add_option("--out", options->out, "Table to write (.sto)")->required();
  joining->add_flag("--json", options->json, "Print JSON, for programs");
  joining->add_option("--map", options->mapping,
                      "TOML file: muscle = [\"column\", ...]. Without it numbered parts join");
  joining->add_option("--pair", options->pairs, "Motion and result whose names differ; may be repeated")
      ->allow_extra_args(false);
  joining->add_option("--coord", options->coordinates, "Keep this coordinate only; may be repeated (default: all)")
      ->allow_extra_args(false);
  joining->add_option("--tolerance", options->settings.tolerance, "Farthest that joined times may lie apart, s")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  const std::map<std::string, CombineParts> ways = {
      {"sum", CombineParts::sum}, {"weighted_mean", CombineParts::weighted_mean}, {"maximum", CombineParts::maximum}};
  joining->add_option("--combine", options->settings.combine, "How a muscle's parts become one")
      ->transform(CLI::CheckedTransformer(ways))
      ->default_str("sum");
  joining->add_option("--forces", options->forces, "Forces for the weighted mean: a file or a folder");
  joining->callback([&chosen, options] { chosen = [options] { return join(*options); }; });
  add_neighbors_command(*command, chosen);
}

}  // namespace gracilis
