#include <gracilis/opensim/export/run_lengths.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/run/run_manifest.hpp>
#include <gracilis/io/tables/action_tables.hpp>
#include <gracilis/io/tables/table.hpp>
#include <gracilis/opensim/import/scene_joints.hpp>
#include <gracilis/opensim/kinematics/coordinate_motion.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace gracilis::opensim {

/// The columns that are a muscle's mean: its first fiber comes next.
static std::vector<std::size_t> mean_columns(const Table& table) {
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i + 1 < table.columns.size(); ++i)
    if (table.columns[i + 1] == table.columns[i] + "_f000") columns.push_back(i);
  return columns;
}

/// Adds the arms about one axis of the scene to those about the coordinates that move it.
static void add_axis_arms(const Table& table, const SceneAxis& axis, LengthSamples& samples) {
  for (MuscleLengths& muscle : samples.muscles) {
    const auto column = column_of(table, muscle.name);
    if (!column || table.values.rows() != samples.coordinates.rows()) continue;
    muscle.arms.conservativeResizeLike(Eigen::MatrixXd::Zero(samples.coordinates.rows(), samples.coordinates.cols()));
    for (Eigen::Index row = 0; row < table.values.rows(); ++row) {
      std::vector<Real> arguments;
      for (const Index i : axis.axis->coordinates) arguments.push_back(samples.coordinates(row, i));
      for (std::size_t k = 0; k < arguments.size(); ++k)
        muscle.arms(row, axis.axis->coordinates[k]) +=
            table.values(row, *column) * derivative(axis.axis->function, arguments, {static_cast<int>(k)});
    }
  }
}

static bool follows_lines(const std::filesystem::path& run) {
  if (!std::filesystem::exists(run / "run.json")) return false;
  const nlohmann::ordered_json manifest = read_manifest(run);
  return manifest.value("settings", "").starts_with("method = \"cylinder\"");
}

Points mean_fiber(const Polylines& fibers, Index count) {
  if (fibers.count() == 0) return Points(3, 0);
  Points mean = Points::Zero(3, count);
  for (Index i = 0; i < fibers.count(); ++i) mean += resampled(fibers.line(i), count - 1);
  return mean / fibers.count();
}

LengthSamples run_lengths(const std::filesystem::path& run, const Model& model) {
  const std::filesystem::path path = run / "fiber_lengths.sto";
  const Table table = read_table(path);
  const std::vector<std::size_t> means = mean_columns(table);
  if (means.empty()) throw InputError({path.string(), "", "holds no lengths of muscles", "name the folder of a run"});
  LengthSamples samples;
  samples.coordinates = coordinate_motion(model, table).values;
  samples.follow_lines = follows_lines(run);
  const Eigen::VectorXd moved = samples.coordinates.colwise().maxCoeff() - samples.coordinates.colwise().minCoeff();
  if (table.times.size() < 4 || moved.maxCoeff() < 1e-6)
    throw InputError({path.string(), "", "holds no motion to fit lengths to", "run a motion of several frames first"});
  for (const std::size_t i : means)
    samples.muscles.push_back({table.columns[i], table.values.col(static_cast<Eigen::Index>(i)),
                               Eigen::MatrixXd(samples.coordinates.rows(), 0)});
  for (const Joint& joint : model.joints)
    for (const SceneAxis& axis : scene_axes(model, joint))
      if (const auto file = run / moment_arm_file(axis.coordinate, table.columns); std::filesystem::exists(file))
        add_axis_arms(read_table(file), axis, samples);
  return samples;
}

/// What an axis is called that follows other coordinates (opensim/import/scene_joints).
static bool is_made_up(const std::string& joint, const std::string& coordinate) {
  return coordinate.starts_with(joint + "_translation") || coordinate.starts_with(joint + "_rotation");
}

Model joints_of_run(const std::filesystem::path& run) {
  const nlohmann::ordered_json manifest = read_manifest(run);
  if (!manifest.contains("joints"))
    throw InputError({(run / "run.json").string(), "", "does not say which joints the coordinates belong to",
                      "add --model MODEL.osim, or run the scene again"});
  Model model;
  model.name = manifest.value("scene", "");
  model.bodies.resize(1);
  model.bodies[0].name = "ground";
  for (const auto& each : manifest["joints"]) {
    Joint joint;
    joint.name = each.value("name", "");
    std::size_t rotations = 0, translations = 3;
    for (const auto& axis : each.value("coordinates", nlohmann::ordered_json::array())) {
      Coordinate coordinate;
      coordinate.name = axis.value("name", "");
      coordinate.rotation = !axis.value("translation", false);
      coordinate.joint = static_cast<Index>(model.joints.size());
      std::size_t& place = coordinate.rotation ? rotations : translations;
      if (is_made_up(joint.name, coordinate.name) || place >= (coordinate.rotation ? 3u : 6u)) continue;
      const auto index = static_cast<Index>(model.coordinates.size());
      joint.axes[place].coordinates = {index};
      joint.axes[place++].function = linear(1, 0);
      joint.coordinates.push_back(index);
      model.coordinates.push_back(std::move(coordinate));
    }
    model.joints.push_back(std::move(joint));
  }
  return model;
}

std::string coordinate_path(const Model& model, Index coordinate) {
  const Coordinate& known = model.coordinates[static_cast<std::size_t>(coordinate)];
  return fmt::format("/jointset/{}/{}", model.joints[static_cast<std::size_t>(known.joint)].name, known.name);
}

}  // namespace gracilis::opensim
