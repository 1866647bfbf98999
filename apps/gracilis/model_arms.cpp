#include "model_arms.hpp"

#include "opensim_model.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/draft/name_search.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/opensim/export/scene_lengths.hpp>
#include <gracilis/opensim/paths/path_tables.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>

namespace gracilis {

namespace {

constexpr int arm_steps = 200;
constexpr Real least_arm = 1e-6;         // m
constexpr Real certainly_spelled = 0.7;  // of a NameMatch: not merely by letters alike

Index coordinate_called(const std::filesystem::path& file, const opensim::Model& model, const std::string& name) {
  const Index index = opensim::index_of(model.coordinates, name);
  if (index < 0)
    throw InputError({file.string(), "", fmt::format("has no coordinate '{}'", name),
                      suggestion(name, opensim::names_of(model.coordinates))});
  return index;
}

/// Of a range's numbers, in rad or m.
Real unit_of(const opensim::Coordinate& coordinate) { return coordinate.rotation ? radians(1) : 0.001; }

/// Brings the model's default pose to where the scene is.
void pose_as_scene(const std::filesystem::path& file, const Scene& scene, const std::vector<CoordinateRange>& ranges,
                   opensim::Model& model) {
  const Eigen::VectorXd captured = opensim::captured_coordinates(model, scene);
  for (std::size_t i = 0; i < model.coordinates.size(); ++i)
    model.coordinates[i].default_value = captured[static_cast<Eigen::Index>(i)];
  for (const CoordinateRange& range : ranges) {
    opensim::Coordinate& coordinate =
        model.coordinates[static_cast<std::size_t>(coordinate_called(file, model, range.name))];
    if (!range.moves()) coordinate.default_value = range.from * unit_of(coordinate);
  }
}

/// Whether a name means this muscle or a part of it.
bool is_part_of(const std::string& name, const std::string& muscle) {
  const NameWords words = read_name(name, dictionary().words), of_muscle = read_name(muscle, dictionary().words);
  const bool other_side =
      words.side != of_muscle.side && words.side != BodySide::none && of_muscle.side != BodySide::none;
  const NameMatch<KnownMuscle> part = find_muscle(words), whole = find_muscle(of_muscle);
  if (other_side || !whole.known || part.known != whole.known) return false;
  return std::min(part.certainty, whole.certainty) > certainly_spelled &&
         (whole.rest.empty() || whole.rest == part.rest);
}

/// The scene's muscles beside which a muscle of the model is drawn.
std::vector<std::string> muscles_beside(const Scene& scene, const opensim::Model& model, const std::string& name) {
  std::vector<std::string> found;
  for (const Muscle& muscle : scene.muscles) {
    if (muscle.name == name) return {name};
    if (opensim::index_of(model.muscles, muscle.name) < 0 && is_part_of(name, muscle.name))
      found.push_back(muscle.name);
  }
  return found;
}

/// `like` has the coordinate, the source and the angles; `arms` a row for each of these, a column per muscle.
std::vector<ArmCurve> curves_beside(const Scene& scene, const opensim::Model& model, const ArmCurve& like,
                                    const Table& arms) {
  std::vector<ArmCurve> curves;
  std::vector<std::string> left_out;
  for (std::size_t i = 0; i < arms.columns.size(); ++i) {
    const std::string& name = arms.columns[i];
    const Eigen::VectorXd values = arms.values.col(static_cast<Eigen::Index>(i));
    if (values.cwiseAbs().maxCoeff() < least_arm) continue;
    const std::vector<std::string> beside = muscles_beside(scene, model, name);
    if (beside.empty()) left_out.push_back(name);
    for (const std::string& muscle : beside) {
      ArmCurve& curve = curves.emplace_back(like);
      curve.muscle = muscle;
      if (muscle != name) curve.source += " " + name;
      curve.arms.assign(values.begin(), values.end());
    }
  }
  if (!left_out.empty())
    spdlog::info("{}: left out, since the scene has no such muscle: {}", like.source, fmt::join(left_out, ", "));
  return curves;
}

}  // namespace

std::vector<ArmCurve> model_arms(const std::filesystem::path& file, const Scene& scene,
                                 const std::vector<CoordinateRange>& ranges) {
  opensim::Model model = read_opensim_model(file, false);
  if (model.muscles.empty()) throw InputError({file.string(), "", "has no muscles", "name another model"});
  pose_as_scene(file, scene, ranges, model);
  const CoordinateRange& moving =
      *std::find_if(ranges.begin(), ranges.end(), [](const CoordinateRange& range) { return range.moves(); });
  const Index index = coordinate_called(file, model, moving.name);
  if (opensim::is_dependent(model, index))
    throw InputError({file.string(), "", fmt::format("lets '{}' follow other coordinates", moving.name),
                      "move the coordinate that it follows"});
  const Real unit = unit_of(model.coordinates[static_cast<std::size_t>(index)]);
  const Real begin = unit * std::min(moving.from, moving.to), end = unit * std::max(moving.from, moving.to);
  const opensim::CoordinateMotion motion = opensim::sweep(model, index, begin, end, (end - begin) / arm_steps);
  for (const std::string& note : motion.notes) spdlog::warn("{}: {}", file.string(), note);
  ArmCurve like{"", moving.name, file.stem().string()};
  for (Eigen::Index row = 0; row < motion.values.rows(); ++row) like.angles.push_back(motion.values(row, index));
  for (const auto& [coordinate, arms] : opensim::path_tables(model, motion).moment_arms)
    if (coordinate == moving.name) return curves_beside(scene, model, like, arms);
  spdlog::warn("{}: no muscle acts about {}", file.string(), moving.name);
  return {};
}

}  // namespace gracilis
