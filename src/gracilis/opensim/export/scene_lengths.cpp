#include <gracilis/opensim/export/scene_lengths.hpp>

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/anatomy/joints/joint_twists.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/sobol_points.hpp>
#include <gracilis/io/tables/table.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/opensim/import/scene_joints.hpp>
#include <gracilis/opensim/reader/crossed_coordinates.hpp>
#include <gracilis/simulate/fiber_tracker.hpp>
#include <gracilis/simulate/run.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis::opensim {

namespace {

/// An axis of a scene, as the model knows it.
struct KnownAxis {
  std::size_t place;  ///< in the scene's coordinates
  SceneAxis axis;
};

}  // namespace

static std::vector<KnownAxis> known_axes(const Model& model, const Scene& scene) {
  const std::vector<std::string> names = coordinate_names(scene);
  std::vector<KnownAxis> known;
  for (const Joint& joint : model.joints)
    for (const SceneAxis& axis : scene_axes(model, joint))
      if (const auto found = std::find(names.begin(), names.end(), axis.coordinate); found != names.end())
        known.push_back({static_cast<std::size_t>(found - names.begin()), axis});
  return known;
}

Eigen::VectorXd captured_coordinates(const Model& model, const Scene& scene) {
  Eigen::VectorXd values = default_coordinates(model);
  const std::vector<Real> capture = capture_coordinates(scene);
  for (const auto& [place, axis] : known_axes(model, scene))
    if (const Index index = index_of(model.coordinates, axis.coordinate); index >= 0) values[index] = capture[place];
  apply_couplers(model, values);
  return values;
}

/// Arms about the scene's axes as arms about the model's coordinates.
static Eigen::VectorXd arms_of_model(const std::vector<KnownAxis>& known, const Eigen::VectorXd& scene_arms,
                                     const Eigen::VectorXd& values) {
  Eigen::VectorXd arms = Eigen::VectorXd::Zero(values.size());
  for (const auto& [place, axis] : known) {
    std::vector<Real> arguments;
    for (const Index i : axis.axis->coordinates) arguments.push_back(values[i]);
    for (std::size_t k = 0; k < arguments.size(); ++k)
      arms[axis.axis->coordinates[k]] += scene_arms[static_cast<Eigen::Index>(place)] *
                                         derivative(axis.axis->function, arguments, {static_cast<int>(k)});
  }
  return arms;
}

static bool is_doubtful(const FiberActions& actions) {
  return 2 * std::count(actions.doubtful.begin(), actions.doubtful.end(), 1) >
         static_cast<std::ptrdiff_t>(actions.doubtful.size());
}

LengthSamples scene_lengths(const Scene& scene, DeformationMethod& method, const Model& model, const CoordinateBox& box,
                            Index count, const std::function<void(Index)>& progress, Index fiber_points) {
  if (box.coordinates.empty() || static_cast<int>(box.coordinates.size()) > most_sobol_dimensions)
    throw ConfigurationError(
        {"--sample", "",
         fmt::format("the muscles cross {} coordinates that may move; poses are spread over 1 to {}",
                     box.coordinates.size(), most_sobol_dimensions),
         "run fewer muscles, or a motion that moves their joints"});
  const std::vector<KnownAxis> known = known_axes(model, scene);
  const Eigen::VectorXd capture = captured_coordinates(model, scene);
  const Eigen::MatrixXd poses = spread_poses(box, count);
  method.reset();
  const Frame rest = capture_frame(scene, capture_pose(scene.bodies.size()), method);
  const FiberTracker tracker(scene, &rest);
  LengthSamples samples;
  samples.spread = true;
  samples.coordinates = capture.transpose().replicate(count + 1, 1);
  for (const gracilis::Muscle& muscle : scene.muscles)
    samples.muscles.push_back({muscle.name, Eigen::VectorXd(count + 1), Eigen::MatrixXd(count + 1, capture.size())});
  for (Index row = 0; row <= count; ++row) {
    Eigen::VectorXd values = capture;
    std::vector<Real> axes = capture_coordinates(scene);
    method.reset();
    if (row > 0) {
      for (std::size_t i = 0; i < box.coordinates.size(); ++i)
        values[box.coordinates[i]] = poses(row - 1, static_cast<Eigen::Index>(i));
      apply_couplers(model, values);
      for (const auto& [place, axis] : known) axes[place] = value_of(axis, values);
    }
    const Pose pose = pose_at(scene, axes);
    if (row > 0) method.advance(pose, usual_time_step);
    samples.scene_poses.push_back(pose.bodies);
    samples.coordinates.row(row) = values;
    Frame frame = rest;
    method.write(frame);
    const std::vector<MuscleFibers> fibers = tracker.follow(frame);
    const std::vector<FiberActions> actions = method.fiber_actions(joint_twists(scene, axes));
    if (actions.empty())
      throw ConfigurationError({"--sample", "", "the run's method knows no moment arms", "run it with method=strings"});
    for (std::size_t m = 0; m < samples.muscles.size(); ++m) {
      const bool whole = actions[m].arms.rows() > 0 && !is_doubtful(actions[m]);
      samples.muscles[m].lengths[row] = whole ? fibers[m].mean_length : std::numeric_limits<Real>::quiet_NaN();
      samples.muscles[m].arms.row(row).setZero();
      if (fiber_points > 0) samples.muscles[m].fibers.push_back(mean_fiber(fibers[m].lines, fiber_points));
      if (whole) samples.muscles[m].arms.row(row) = arms_of_model(known, actions[m].mean_arms, values);
    }
    if (progress) progress(row);
  }
  return samples;
}

/// The scene with those muscles alone whose line it knows.
static Scene with_lines(Scene scene) {
  std::erase_if(scene.muscles, [](const gracilis::Muscle& muscle) { return muscle.action_line.rays == 0; });
  scene.transversals.clear();
  scene.activation = {};
  return scene;
}

/// The same, moved by their lines.
static Scene moved_by_lines(Scene scene) {
  scene.method = {};
  scene.method.name = "cylinder";
  for (gracilis::Muscle& muscle : scene.muscles) muscle.settings = {};
  return scene;
}

/// The scene's coordinates in each row of the run, rad and m. Those of a ramp need not be what the model's joints
/// allow.
static Eigen::MatrixXd scene_coordinates(const Scene& scene, const Table& table) {
  const std::vector<Real> capture = capture_coordinates(scene);
  Eigen::MatrixXd values =
      Eigen::Map<const Eigen::RowVectorXd>(capture.data(), static_cast<Eigen::Index>(capture.size()))
          .replicate(table.values.rows(), 1);
  const std::vector<std::string> names = coordinate_names(scene);
  std::size_t place = 0;
  for (const gracilis::Joint& joint : scene.joints)
    for (const auto& axis : joint.axes) {
      if (const auto column = column_of(table, names[place]))
        values.col(static_cast<Eigen::Index>(place)) =
            table.values.col(*column) * (table.in_degrees && !axis.translation ? radians(1) : 1);
      ++place;
    }
  return values;
}

void add_line_lengths(const Scene& scene, const std::filesystem::path& run, LengthSamples& samples) {
  const Scene own = with_lines(scene), lines = moved_by_lines(own);
  if (own.muscles.empty()) return;
  const auto method = make_method(lines, [](const DistanceFieldSettings&) { return std::vector<DistanceField>{}; });
  const Frame rest = capture_frame(lines, capture_pose(lines.bodies.size()), *method);
  const FiberTracker tracker(own, &rest);  // fibers as the run has them
  const Eigen::MatrixXd coordinates = scene_coordinates(lines, read_table(run / "fiber_lengths.sto"));
  std::vector<MuscleLengths*> wanted;
  for (const gracilis::Muscle& muscle : lines.muscles) {
    const auto found = std::find_if(samples.muscles.begin(), samples.muscles.end(),
                                    [&](const MuscleLengths& each) { return each.name == muscle.name; });
    wanted.push_back(found == samples.muscles.end() ? nullptr : &*found);
    if (wanted.back()) wanted.back()->line_lengths.resize(coordinates.rows());
  }
  for (Eigen::Index row = 0; row < coordinates.rows(); ++row) {
    const std::vector<Real> axes(coordinates.row(row).begin(), coordinates.row(row).end());
    method->advance(pose_at(lines, axes), usual_time_step);
    Frame frame = rest;
    method->write(frame);
    const std::vector<MuscleFibers> fibers = tracker.follow(frame);
    for (std::size_t m = 0; m < wanted.size(); ++m)
      if (wanted[m]) wanted[m]->line_lengths[row] = fibers[m].mean_length;
  }
}

/// Whether any of the run's muscles crosses the coordinate, as far as the model knows them.
static std::vector<bool> crossed_by_any(const LengthSamples& run, const Model& model) {
  std::vector<bool> crossed(model.coordinates.size(), false);
  for (const MuscleLengths& muscle : run.muscles) {
    const Index known = index_of(model.muscles, muscle.name);
    if (known < 0) return std::vector<bool>(model.coordinates.size(), true);
    for (const Index i : crossed_coordinates(model, model.muscles[static_cast<std::size_t>(known)].path))
      crossed[static_cast<std::size_t>(i)] = true;
  }
  return crossed;
}

std::vector<Index> moved_coordinates(const LengthSamples& run, const Model& model, const Scene& scene) {
  const std::vector<std::string> names = coordinate_names(scene);
  const std::vector<bool> crossed = crossed_by_any(run, model);
  std::vector<Index> moved;
  for (std::size_t i = 0; i < model.coordinates.size(); ++i) {
    if (!crossed[i] || is_dependent(model, static_cast<Index>(i))) continue;
    const auto column = run.coordinates.col(static_cast<Eigen::Index>(i));
    if (column.maxCoeff() - column.minCoeff() > 1e-6 &&
        std::find(names.begin(), names.end(), model.coordinates[i].name) != names.end())
      moved.push_back(static_cast<Index>(i));
  }
  return moved;
}

}  // namespace gracilis::opensim
