#include "paths_command.hpp"

#include "opensim_model.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/io/json_file.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/value_reader.hpp>
#include <gracilis/opensim/paths/path_tables.hpp>
#include <gracilis/scene/names.hpp>
#include <gracilis/view/charts/run_charts.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <memory>
#include <set>

namespace gracilis {

namespace {

namespace fs = std::filesystem;

struct PathsOptions {
  fs::path model, motion, out;
  std::string sweep, prefix, lengths = "geodesic";
  bool strict = false, json = false;
};

/// What tables and plots are over: the swept coordinate, in degrees or m, or else the time.
struct PathsAxis {
  std::string name = "time", label = "time (s)";
  std::string column = "time";  ///< of a table for people: with its unit, as in swing_deg
  Real plot_factor = 1;
  Eigen::VectorXd values;
};

PathsAxis axis_of(const opensim::Model& model, const opensim::CoordinateMotion& motion, const std::string& swept) {
  const auto rows = static_cast<Eigen::Index>(motion.times.size());
  if (swept.empty()) return {.values = Eigen::VectorXd::Map(motion.times.data(), rows)};
  const Index number = opensim::index_of(model.coordinates, swept);
  const bool rotation = model.coordinates[static_cast<std::size_t>(number)].rotation;
  return {swept, swept + (rotation ? " (degrees)" : " (mm)"), swept + (rotation ? "_deg" : "_m"),
          rotation ? 1.0 : 1000.0, motion.values.col(number) / (rotation ? radians(1) : 1)};
}

/// The table with the axis as its first column.
Table with_first_column(const Table& table, const PathsAxis& axis, const std::string& name) {
  Table all = table;
  all.columns.insert(all.columns.begin(), name);
  all.values.resize(table.values.rows(), table.values.cols() + 1);
  all.values << axis.values, table.values;
  all.in_degrees = true;
  return all;
}

/// The muscles whose values change.
std::vector<std::string> changing_muscles(const Table& table) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const Eigen::VectorXd column = table.values.col(static_cast<Eigen::Index>(i));
    if (column.maxCoeff() - column.minCoeff() > 1e-6) names.push_back(table.columns[i]);
  }
  return names;
}

/// "hip_flexion_r=-40:120:5", in degrees or m.
opensim::CoordinateMotion parse_sweep(const opensim::Model& model, const std::string& text) {
  const std::size_t equals = text.find('='), first = text.find(':'), second = text.find(':', first + 1);
  double begin = 0, end = 0, step = 0;
  const bool whole = equals != std::string::npos && first != std::string::npos && second != std::string::npos &&
                     equals < first && parse_number(text.substr(equals + 1, first - equals - 1), begin) &&
                     parse_number(text.substr(first + 1, second - first - 1), end) &&
                     parse_number(text.substr(second + 1), step) && std::isfinite(begin) && std::isfinite(end) &&
                     std::isfinite(step) && step > 0;
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
  for (const opensim::LengthsApart& each : opensim::lengths_apart(tables))
    spdlog::warn(
        "{}: {}, up to {:.1f} mm off {}", each.muscle,
        ways ? "lengths are those of the way around its wraps, of which the moment arms are"
             : "lengths are as OpenSim computes them (--lengths opensim)",
        1000 * each.most,
        ways ? "what OpenSim computes; --lengths opensim gives that"
             : "those of the way around its wraps, of which the moment arms are; --lengths geodesic gives these");
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
  fs::create_directories(options.out / "plots");
  const bool sweeps = options.motion.empty(), ways = options.lengths == "geodesic";
  const PathsAxis axis =
      axis_of(model, motion, sweeps ? options.sweep.substr(0, options.sweep.find('=')) : std::string());
  const std::string start = file_name_of(options.prefix.empty() ? model.name : options.prefix);
  std::set<std::string> taken, plots_taken;
  nlohmann::ordered_json files = nlohmann::json::array(), apart = files;
  const auto say_written = [&](const fs::path& path) {
    files.push_back(path.string());
    if (!options.json) fmt::print("{}\n", path.string());
  };
  const auto write = [&](const std::string& what, const Table& table) {
    fs::path path = options.out / (start + "_" + file_name_of(what, taken) + ".sto");
    write_sto(path, table);
    say_written(path);
    return path;
  };
  const auto write_and_plot = [&](const std::string& what, const Table& table, const std::string& title,
                                  const std::string& y_label) {
    const Table all = with_first_column(table, axis, axis.name);
    const fs::path written = write(what, sweeps ? all : table);
    if (sweeps) {
      // OpenSim wants time first, everybody else the angle.
      const fs::path plain = fs::path(written).replace_extension(".csv");
      write_csv(plain, with_first_column(table, axis, axis.column));
      say_written(plain);
    }
    const std::vector<std::string> muscles = changing_muscles(table);
    if (muscles.empty()) return;
    const fs::path path = options.out / "plots" / (start + "_" + file_name_of(title, plots_taken) + ".svg");
    write_chart(path, muscles_chart(all, {axis.name, axis.plot_factor, axis.label}, muscles, model.name + ": " + title,
                                    y_label));
    say_written(path);
  };
  warn_of_other_ways(tables, ways);
  write_and_plot("MuscleAnalysis_Length", ways ? tables.way_lengths : tables.lengths, "lengths", "length (mm)");
  for (const auto& [coordinate, table] : tables.moment_arms) {
    const bool rotation =
        model.coordinates[static_cast<std::size_t>(opensim::index_of(model.coordinates, coordinate))].rotation;
    write_and_plot("MuscleAnalysis_MomentArm_" + coordinate, table,
                   (rotation ? "moment arms about " : "shortening along ") + coordinate,
                   rotation ? "moment arm (mm)" : "shortening (mm per m)");
  }
  if (sweeps) write("coordinates", opensim::coordinate_table(model, motion));
  if (options.json) {
    for (const opensim::LengthsApart& each : opensim::lengths_apart(tables))
      apart.push_back({{"muscle", each.muscle}, {"most_mm", 1000 * each.most}});
    fmt::print("{}", json_text({{"model", model.name},
                                {"muscles", model.muscles.size()},
                                {"rows", motion.times.size()},
                                {"over", axis.name},
                                {"files", files},
                                {"lengths_apart", apart}}));
  }
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_paths_command(CLI::App& program, Command& chosen) {
  CLI::App* command = program.add_subcommand("paths", "Lengths and moment arms of an OpenSim model's muscles");
  const auto options = std::make_shared<PathsOptions>();
  command->add_option("MODEL", options->model, "OpenSim model (.osim)")->required();
  command->add_option("--motion", options->motion, "Coordinates over time (.mot, .sto)");
  command->add_option("--coord", options->sweep, "Or one coordinate, NAME=FROM:TO:STEP in degrees or m");
  command->add_option("--out", options->out, "Folder for the tables, and plots/ of them")->required();
  command->add_option("--prefix", options->prefix, "Start of the tables' names (default: the model's name)");
  command
      ->add_option(
          "--lengths", options->lengths,
          "'geodesic': of the way around the wraps that moment arms are of; 'opensim': as OpenSim computes them "
          "(default: geodesic)")
      ->check(CLI::IsMember({"geodesic", "opensim"}));
  command->add_flag("--strict", options->strict, "Fail where the model holds what is not supported (exit code 4)");
  command->add_flag("--json", options->json, "Print what was written, and whose lengths differ, as JSON, for programs");
  command->callback([&chosen, options] { chosen = [options] { return write_paths(*options); }; });
}

}  // namespace gracilis
