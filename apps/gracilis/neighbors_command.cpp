#include "neighbors_command.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/io/json_file.hpp>
#include <gracilis/io/run/recorded_run.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/tables/table.hpp>
#include <gracilis/view/charts/neighbor_charts.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace gracilis {

namespace {

namespace fs = std::filesystem;

struct NeighborsOptions {
  fs::path samples, poses, out;
  std::vector<std::string> coordinates;
  int neighbors = JointControlUnit().neighbors;
  Real hit_deg = degrees(JointControlUnit().hit_distance);
  bool json = false;
};

/// The frames of a run, or the rows of a motion, rad.
Motion motion_of(const fs::path& path) {
  if (!fs::is_directory(path)) return motion_from_table(read_table(path));
  const RecordedRun run = open_recorded_run(path);
  Motion motion{path.string(), {}, run.times, run.coordinate_values};
  for (std::size_t c = 0; c < run.coordinates.size(); ++c) {
    const CoordinateLabel label = coordinate_label(run.coordinates[c]);
    motion.coordinates.push_back(label.name);
    if (label.unit == "°") motion.values.col(static_cast<Index>(c)) *= radians(1);
  }
  return motion;
}

/// The columns of these coordinates.
Eigen::MatrixXd columns_of(const fs::path& file, const std::vector<std::string>& all, const Eigen::MatrixXd& values,
                           const std::vector<std::string>& coordinates) {
  Eigen::MatrixXd chosen(values.rows(), static_cast<Index>(coordinates.size()));
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const auto found = std::find(all.begin(), all.end(), coordinates[i]);
    if (found == all.end())
      throw ConfigurationError(
          {file.string(), "", "has no coordinate '" + coordinates[i] + "'", suggestion(coordinates[i], all)});
    chosen.col(static_cast<Index>(i)) = values.col(found - all.begin());
  }
  return chosen;
}

int show_neighbors(const NeighborsOptions& options) {
  const Table samples = read_table(options.samples);
  const Motion motion = motion_of(options.poses);
  JointControlUnit unit;
  unit.coordinates = options.coordinates;
  for (const std::string& name : samples.columns)
    if (options.coordinates.empty() &&
        std::find(motion.coordinates.begin(), motion.coordinates.end(), name) != motion.coordinates.end())
      unit.coordinates.push_back(name);
  if (unit.coordinates.empty())
    throw ConfigurationError(
        {options.samples.string(), "", "has no coordinate that the poses have", "--coord names one"});
  unit.neighbors = options.neighbors;
  unit.hit_distance = radians(options.hit_deg);
  unit.angles = (samples.in_degrees ? radians(1) : 1) *
                columns_of(options.samples, samples.columns, samples.values, unit.coordinates);
  unit.activations = Eigen::MatrixXd(unit.angles.rows(), 0);
  const AskedSamples asked =
      asked_samples(unit, columns_of(options.poses, motion.coordinates, motion.values, unit.coordinates));
  write_asked_samples(options.out, asked);
  if (options.json)
    fmt::print("{}", json_text({{"folder", options.out.string()},
                                {"coordinates", asked.coordinates},
                                {"samples", asked.samples.rows()},
                                {"poses", asked.poses.rows()},
                                {"asked", asked.used()}}));
  else
    fmt::print("{} of {} samples are asked in {} poses\n{}\n", asked.used(), asked.samples.rows(), asked.poses.rows(),
               options.out.string());
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_neighbors_command(CLI::App& activations, Command& chosen) {
  CLI::App* command =
      activations.add_subcommand("neighbors", "Show which samples a joint control unit asks in some poses");
  command->footer("Example: gracilis activations neighbors samples.sto leg --out neighbors");
  const auto options = std::make_shared<NeighborsOptions>();
  command->add_option("SAMPLES", options->samples, "Table of samples (.sto), as join writes it")->required();
  command->add_option("POSES", options->poses, "Run folder, or motion (.mot, .sto)")->required();
  command->add_option("--out", options->out, "Folder to write: neighbors.csv, and a picture for every two coordinates")
      ->required();
  command
      ->add_option("--coord", options->coordinates,
                   "A coordinate of the unit; may be repeated (default: those of both)")
      ->allow_extra_args(false);
  command->add_option("--neighbors", options->neighbors, "How many samples are asked")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  command->add_option("--hit-deg", options->hit_deg, "A sample nearer than this is asked alone, degrees")
      ->check(CLI::Range(0.0, 360.0))
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print JSON, for programs");
  command->callback([&chosen, options] { chosen = [options] { return show_neighbors(*options); }; });
}

}  // namespace gracilis
