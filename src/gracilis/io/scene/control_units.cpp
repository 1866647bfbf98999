#include <gracilis/io/scene/control_units.hpp>

#include <gracilis/io/scene/files.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/tables/table.hpp>

#include <fmt/format.h>

namespace gracilis::sections {

namespace fs = std::filesystem;

/// How parts of muscles become one.
static void read_combination(TomlReader& table, ControlUnitDescription& description) {
  const std::string way = table.text("combine").value_or("sum");
  description.forces = file_at(table, "forces");
  if (const std::optional<CombineParts> combine = find_combination(way)) {
    description.combine = *combine;
  } else {
    table.add_problem("combine", "there is no way '" + way + "' to combine parts of a muscle",
                      "'sum', 'weighted_mean' or 'maximum'");
  }
  if ((description.combine == CombineParts::weighted_mean) == description.forces.path.empty())
    table.add_problem("combine", "'forces' and combine = \"weighted_mean\" need each other",
                      "give both, or neither for the sum or the maximum");
}

ControlUnitDescription read_control_unit(TomlReader table) {
  ControlUnitDescription description;
  JointControlUnit& unit = description.unit;
  description.place = table.place();
  unit.name = table.required_text("name");
  unit.joint = table.required_text("joint");
  description.samples = file_at(table, "samples");
  description.motion = file_at(table, "motion");
  description.results = file_at(table, "results");
  description.names = file_at(table, "names");
  read_combination(table, description);
  const bool joined = !description.motion.path.empty() && !description.results.path.empty();
  const bool tells_how = table.has("motion") || table.has("results") || table.has("names") || table.has("combine");
  if (description.samples.path.empty() ? !joined : tells_how) {
    Problem problem = table.place();
    problem.what = "the samples of a joint control unit are given in exactly one way";
    problem.remedy = "give 'samples', or 'motion' and 'results'";
    table.add_problem(problem);
  }
  unit.coordinates = table.texts("coordinates");
  unit.muscles = table.texts("muscles");
  unit.falloff = table.number("falloff", {0, 1e9, "1/deg²"}).value_or(0);
  unit.neighbors = table.integer("neighbors", 1, 100'000).value_or(unit.neighbors);
  if (const std::optional<Real> hit = table.number("hit_deg", {0, 360, "deg"})) unit.hit_distance = radians(*hit);
  table.reject_unknown_keys();
  return description;
}

/// What `gracilis activations join` makes of the unit's files; no rows where one of them cannot be read.
static Table join(SceneInProgress& progress, const ControlUnitDescription& description, const fs::path& results) {
  Trial trial{description.unit.name, {}, read_table(results), {}};
  JoinSettings settings;
  settings.combine = description.combine;
  read_file(progress, description.motion, [&](const fs::path& path) { trial.motion = read_table(path); });
  if (!description.names.path.empty())
    read_file(progress, description.names, [&](const fs::path& path) { settings.muscles = read_muscle_mapping(path); });
  const bool weighted = !description.forces.path.empty();
  if (weighted) read_file(progress, description.forces, [&](const fs::path& path) { trial.forces = read_table(path); });
  if (trial.motion.columns.empty() || (weighted && trial.forces.columns.empty())) return {};
  JoinedSamples joined = join_samples({trial}, settings);
  for (const std::string& problem : joined.problems)
    progress.loaded.warnings.push_back("joint control unit '" + description.unit.name + "': " + problem);
  return std::move(joined.samples);
}

/// The columns of these names; one that is not there is a problem of the file.
static Eigen::MatrixXd columns_of(SceneInProgress& progress, const Table& table, const std::string& file,
                                  const std::vector<std::string>& names) {
  Eigen::MatrixXd values(table.values.rows(), static_cast<Index>(names.size()));
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (const std::optional<Eigen::Index> found = column_of(table, names[i])) {
      values.col(static_cast<Index>(i)) = table.values.col(*found);
    } else {
      progress.add_problem({file, "", "", ""}, "has no column '" + names[i] + "'", suggestion(names[i], table.columns));
    }
  }
  return values;
}

static std::vector<std::string> coordinates_of_joint(const Scene& scene, const std::string& name) {
  std::vector<std::string> coordinates;
  for (const Joint& joint : scene.joints)
    if (joint.name == name)
      for (const JointAxis& axis : joint.axes) coordinates.push_back(axis.coordinate);
  return coordinates;
}

static std::vector<std::string> muscles_with_column(const Scene& scene, const Table& table) {
  std::vector<std::string> muscles;
  for (const Muscle& muscle : scene.muscles)
    if (column_of(table, muscle.name)) muscles.push_back(muscle.name);
  return muscles;
}

/// Sums of parts go beyond full activation, which a muscle cannot.
static void warn_about_excess(SceneInProgress& progress, const JointControlUnit& unit) {
  for (std::size_t i = 0; i < unit.muscles.size(); ++i) {
    const Eigen::VectorXd values = unit.activations.col(static_cast<Index>(i));
    const auto above = (values.array() > 1).count();
    if (above > 0)
      progress.loaded.warnings.push_back(fmt::format(
          "joint control unit '{}': {} is above 1 in {} of {} samples, up to {:.3f}; what comes out is cut off at 1",
          unit.name, unit.muscles[i], above, values.size(), values.maxCoeff()));
  }
}

void add_control_unit(SceneInProgress& progress, const ControlUnitDescription& description) {
  Scene& scene = progress.loaded.scene;
  const bool joined = description.samples.path.empty();
  read_file(progress, joined ? description.results : description.samples, [&](const fs::path& path) {
    const Table table = joined ? join(progress, description, path) : read_table(path);
    JointControlUnit unit = description.unit;
    if (unit.coordinates.empty()) unit.coordinates = coordinates_of_joint(scene, unit.joint);
    if (unit.muscles.empty()) unit.muscles = muscles_with_column(scene, table);
    unit.angles = (table.in_degrees ? radians(1) : 1) * columns_of(progress, table, path.string(), unit.coordinates);
    unit.activations = columns_of(progress, table, path.string(), unit.muscles);
    warn_about_excess(progress, unit);
    scene.activation.units.push_back(std::move(unit));
  });
}

}  // namespace gracilis::sections
