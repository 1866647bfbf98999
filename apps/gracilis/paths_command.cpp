#include "paths_command.hpp"

#include "opensim_model.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/value_reader.hpp>
#include <gracilis/opensim/paths/path_tables.hpp>
#include <gracilis/scene/names.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <set>

namespace gracilis {

namespace {

namespace fs = std::filesystem;

struct PathsOptions {
  fs::path model, motion, out;
  std::string sweep, prefix, lengths = "way";
  bool strict = false;
};

std::vector<std::string> names_of(const std::vector<opensim::Coordinate>& coordinates) {
  std::vector<std::string> names;
  for (const opensim::Coordinate& coordinate : coordinates) names.push_back(coordinate.name);
  return names;
}

/// "hip_flexion_r=-40:120:5", in degrees or m.
opensim::CoordinateMotion parse_sweep(const opensim::Model& model, const std::string& text) {
  const std::size_t equals = text.find('='), first = text.find(':'), second = text.find(':', first + 1);
  double begin = 0, end = 0, step = 0;
  const bool whole = equals != std::string::npos && first != std::string::npos && second != std::string::npos &&
                     equals < first && parse_number(text.substr(equals + 1, first - equals - 1), begin) &&
                     parse_number(text.substr(first + 1, second - first - 1), end) &&
                     parse_number(text.substr(second + 1), step) && step > 0;
  if (!whole) throw ConfigurationError({"--coord", "", fmt::format("'{}' is no sweep", text), "NAME=FROM:TO:STEP"});
  const std::string name = text.substr(0, equals);
  const Index coordinate = opensim::index_of(model.coordinates, name);
  if (coordinate < 0)
    throw ConfigurationError({"--coord", "", fmt::format("the model has no coordinate '{}'", name),
                              suggestion(name, names_of(model.coordinates))});
  const Real unit = model.coordinates[static_cast<std::size_t>(coordinate)].rotation ? radians(1) : 1;
  return opensim::sweep(model, coordinate, begin * unit, end * unit, step * unit);
}

/// Names the muscles whose length by OpenSim is not that of the way that the moment arms are of.
void warn_of_other_ways(const opensim::PathTables& tables, bool ways) {
  const Eigen::RowVectorXd apart = (tables.lengths.values - tables.way_lengths.values).cwiseAbs().colwise().maxCoeff();
  for (std::size_t i = 0; i < tables.lengths.columns.size(); ++i) {
    const Real most = apart[static_cast<Eigen::Index>(i)];
    if (most > 1e-4)
      spdlog::warn("{}: {}, up to {:.1f} mm off {}", tables.lengths.columns[i],
                   ways ? "lengths are those of the way around its wraps, of which the moment arms are"
                        : "lengths are as OpenSim computes them (--lengths opensim)",
                   1000 * most,
                   ways ? "what OpenSim computes; --lengths opensim gives that"
                        : "those of the way around its wraps, of which the moment arms are; --lengths way gives these");
  }
}

int write_paths(const PathsOptions& options) {
  if (options.motion.empty() == options.sweep.empty())
    throw ConfigurationError({"", "", "give either --motion FILE or --coord NAME=FROM:TO:STEP", ""});
  const opensim::Model model = read_opensim_model(options.model, options.strict);
  if (model.muscles.empty()) throw InputError({options.model.string(), "", "has no muscles", "name another model"});
  opensim::CoordinateMotion motion;
  if (options.motion.empty()) {
    motion = parse_sweep(model, options.sweep);
  } else {
    const Table table = read_table(options.motion);
    for (const std::string& warning : table.warnings) spdlog::warn("{}", warning);
    motion = opensim::coordinate_motion(model, table);
  }
  for (const std::string& note : motion.notes) spdlog::warn("{}", note);
  const opensim::PathTables tables = opensim::path_tables(model, motion);
  fs::create_directories(options.out);
  const std::string start = file_name_of(options.prefix.empty() ? model.name : options.prefix);
  std::set<std::string> taken;
  const auto write = [&](const std::string& what, const Table& table) {
    const fs::path path = options.out / (start + "_" + file_name_of(what, taken) + ".sto");
    write_sto(path, table);
    fmt::print("{}\n", path.string());
  };
  const bool ways = options.lengths == "way";
  warn_of_other_ways(tables, ways);
  write("MuscleAnalysis_Length", ways ? tables.way_lengths : tables.lengths);
  for (const auto& [coordinate, table] : tables.moment_arms) write("MuscleAnalysis_MomentArm_" + coordinate, table);
  if (options.motion.empty()) write("coordinates", opensim::coordinate_table(model, motion));
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_paths_command(CLI::App& program, Command& chosen) {
  CLI::App* command = program.add_subcommand("paths", "Lengths and moment arms of an OpenSim model's muscles");
  const auto options = std::make_shared<PathsOptions>();
  command->add_option("MODEL", options->model, "OpenSim model (.osim)")->required();
  command->add_option("--motion", options->motion, "Coordinates over time (.mot, .sto)");
  command->add_option("--coord", options->sweep, "Or one coordinate, NAME=FROM:TO:STEP in degrees or m");
  command->add_option("--out", options->out, "Folder for the tables")->required();
  command->add_option("--prefix", options->prefix, "Start of the tables' names (default: the model's name)");
  command
      ->add_option("--lengths", options->lengths,
                   "Of the 'way' that moment arms are of, or as 'opensim' computes them (default: way)")
      ->check(CLI::IsMember({"opensim", "way"}));
  command->add_flag("--strict", options->strict, "Fail where the model holds what is not supported (exit code 4)");
  command->callback([&chosen, options] { chosen = [options] { return write_paths(*options); }; });
}

}  // namespace gracilis
