#include <gracilis/io/scene/activation.hpp>

#include <gracilis/anatomy/activation/activation.hpp>
#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/io/scene/files.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/tables/table.hpp>

#include <algorithm>

namespace gracilis::sections {

/// Rows of an angle and the activation there.
static Eigen::MatrixXd read_points(TomlReader& table) {
  std::optional<Eigen::MatrixXd> rows = table.rows("points_deg", 2);
  if (!rows) return {};
  for (Index i = 1; i < rows->rows(); ++i)
    if (!((*rows)(i, 0) > (*rows)(i - 1, 0)))
      table.add_problem("points_deg", "the angles of 'points_deg' do not increase");
  rows->col(0) *= radians(1);
  return std::move(*rows);
}

ActivationDescription read_activation(TomlReader table) {
  ActivationDescription activation;
  activation.place = table.place();
  activation.muscles = table.texts("muscle");
  if (activation.muscles.empty() && !table.has("muscle")) table.required_text("muscle");
  activation.value = table.number("value", {0, 1});
  activation.file = file_at(table, "file");
  if (!activation.file.path.empty()) activation.column = table.text("column").value_or("");
  activation.coordinate = table.text("coordinate").value_or("");
  activation.points = read_points(table);
  const bool curve = activation.points.rows() > 0 && !activation.coordinate.empty();
  const int ways = activation.value.has_value() + !activation.file.path.empty() + curve;
  if (ways != 1 || table.has("points_deg") != table.has("coordinate")) {
    Problem problem = table.place();
    problem.what = "an activation is given in exactly one way";
    problem.remedy = "give 'value', or 'file', or 'coordinate' with 'points_deg'";
    table.add_problem(problem);
  }
  table.reject_unknown_keys();
  return activation;
}

/// Of a muscle made of several heads, the mean of their columns, weighted by their largest forces; empty where the
/// table lacks any, or no head has a force.
static std::optional<Eigen::VectorXd> mean_of_heads(const Table& table, const Scene& scene, const std::string& name) {
  const auto muscle =
      std::find_if(scene.muscles.begin(), scene.muscles.end(), [&](const Muscle& each) { return each.name == name; });
  if (muscle == scene.muscles.end()) return {};
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(table.values.rows());
  Real force = 0;
  for (const ActionLine& head : muscle->action_line.heads) {
    const std::optional<Eigen::Index> found = column_of(table, head.name);
    if (!found) return {};
    sum += head.max_isometric_force * table.values.col(*found);
    force += head.max_isometric_force;
  }
  if (!(force > 0)) return {};
  return sum / force;
}

/// The column of that name, or of the muscle's, or of its heads'.
static void add_column(SceneInProgress& progress, const std::filesystem::path& path, const std::string& muscle,
                       const std::string& column) {
  const Table table = read_table(path);
  const std::string& name = column.empty() ? muscle : column;
  const std::optional<Eigen::Index> found = column_of(table, name);
  std::optional<Eigen::VectorXd> values;
  if (found)
    values = table.values.col(*found);
  else if (column.empty())
    values = mean_of_heads(table, progress.loaded.scene, muscle);
  if (!values) {
    progress.add_problem({path.string(), "", "", ""}, "has no column '" + name + "'", suggestion(name, table.columns));
    return;
  }
  progress.loaded.scene.activation.signals.push_back({muscle, table.times, {values->begin(), values->end()}});
}

void add_activation(SceneInProgress& progress, const ActivationDescription& description) {
  ActivationPlan& plan = progress.loaded.scene.activation;
  const std::vector<std::string> coordinates = coordinate_names(progress.loaded.scene);
  for (const std::string& muscle : description.muscles) {
    if (description.value) {
      plan.signals.push_back({muscle, {0}, {*description.value}});
    } else if (!description.coordinate.empty()) {
      const auto found = std::find(coordinates.begin(), coordinates.end(), description.coordinate);
      plan.functions.push_back(
          {muscle, along_coordinate(static_cast<std::size_t>(found - coordinates.begin()), description.points)});
    } else {
      read_file(progress, description.file,
                [&](const std::filesystem::path& path) { add_column(progress, path, muscle, description.column); });
    }
  }
}

}  // namespace gracilis::sections
