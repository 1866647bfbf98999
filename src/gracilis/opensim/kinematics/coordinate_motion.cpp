#include <gracilis/opensim/kinematics/coordinate_motion.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/opensim/kinematics/loop_closer.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

/// Goes from the default pose to the first row by small steps, so that loops stay on the side that they are on.
static void approach(const Model& model, LoopCloser& closer, const std::vector<bool>& held,
                     const Eigen::VectorXd& first, Eigen::VectorXd& pose) {
  Eigen::VectorXd way = Eigen::VectorXd::Zero(pose.size());
  for (std::size_t i = 0; i < held.size(); ++i)
    if (const auto k = static_cast<Eigen::Index>(i); held[i]) way[k] = first[k] - pose[k];
  const Eigen::VectorXd start = pose;
  const int steps = model.loops.empty() ? 0 : static_cast<int>(std::min(way.lpNorm<Eigen::Infinity>() / 0.05, 200.0));
  for (int step = 1; step <= steps; ++step) {
    for (std::size_t i = 0; i < held.size(); ++i)
      if (const auto k = static_cast<Eigen::Index>(i); held[i]) pose[k] = start[k] + way[k] * step / (steps + 1);
    closer.close(pose, held);
  }
}

void complete_rows(const Model& model, const std::vector<bool>& held, CoordinateMotion& motion) {
  LoopCloser closer(model);
  LoopClosure worst;
  Eigen::VectorXd pose = default_coordinates(model);
  if (motion.values.rows() > 0) approach(model, closer, held, motion.values.row(0), pose);
  for (Eigen::Index row = 0; row < motion.values.rows(); ++row) {
    // What loops set goes on from the row before.
    for (std::size_t i = 0; i < held.size(); ++i)
      if (const auto k = static_cast<Eigen::Index>(i); held[i]) pose[k] = motion.values(row, k);
    const LoopClosure closure = closer.close(pose, held);
    motion.values.row(row) = pose;
    worst.open = std::max(worst.open, closure.open);
    if (closure.moved > worst.moved) {
      worst.moved = closure.moved;
      worst.coordinate = closure.coordinate;
    }
  }
  if (worst.coordinate >= 0) {
    const Coordinate& coordinate = model.coordinates[static_cast<std::size_t>(worst.coordinate)];
    motion.notes.push_back(fmt::format(
        "to close the model's loops given coordinates had to give way, {} by {:.3g} {} at most", coordinate.name,
        worst.moved * (coordinate.rotation ? degrees(1) : 1), coordinate.rotation ? "degrees" : "m"));
  }
  if (worst.open > closed_loop)
    motion.notes.push_back(fmt::format("the model's loops stay open by up to {:.3g} (m or rad)", worst.open));
}

CoordinateMotion coordinate_motion(const Model& model, const Table& table) {
  CoordinateMotion motion;
  motion.times = table.times;
  motion.values = default_coordinates(model).transpose().replicate(table.values.rows(), 1);
  std::vector<bool> given(model.coordinates.size(), false);
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    const Index index = index_of(model.coordinates, coordinate_of_column(table.columns[column]));
    if (index < 0) continue;
    const bool degrees_here = table.in_degrees && model.coordinates[static_cast<std::size_t>(index)].rotation;
    motion.values.col(index) = table.values.col(static_cast<Eigen::Index>(column)) * (degrees_here ? radians(1) : 1);
    given[static_cast<std::size_t>(index)] = true;
  }
  if (std::find(given.begin(), given.end(), true) == given.end())
    throw InputError({table.name, "", fmt::format("holds no coordinate of the model '{}'", model.name),
                      "its columns must be named as the model's coordinates"});
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < given.size(); ++i)
    if (!given[i] && !is_dependent(model, static_cast<Index>(i))) missing.push_back(model.coordinates[i].name);
  if (!missing.empty())
    motion.notes.push_back(fmt::format(
        "{}: has no {}, which {}", table.name, fmt::join(missing, ", "),
        model.loops.empty() ? "keep their default values" : "stay as near to their default values as loops let them"));
  complete_rows(model, given, motion);
  return motion;
}

CoordinateMotion sweep(const Model& model, Index coordinate, Real begin, Real end, Real step) {
  const Real steps = std::abs(end - begin) / std::abs(step);
  if (!(steps <= 1e5)) throw ConfigurationError({"", "", "a sweep of more than 100,000 rows", "take a larger step"});
  const auto rows = static_cast<Eigen::Index>(std::floor(steps + 1e-9)) + 1;
  CoordinateMotion motion;
  motion.values = default_coordinates(model).transpose().replicate(rows, 1);
  for (Eigen::Index row = 0; row < rows; ++row) {
    motion.times.push_back(0.01 * static_cast<Real>(row));
    motion.values(row, coordinate) = begin + std::copysign(step, end - begin) * static_cast<Real>(row);
  }
  std::vector<bool> held(model.coordinates.size(), false);
  held[static_cast<std::size_t>(coordinate)] = true;
  complete_rows(model, held, motion);
  return motion;
}

Table coordinate_table(const Model& model, const CoordinateMotion& motion) {
  Table table;
  table.name = "Coordinates";
  table.times = motion.times;
  table.values = motion.values;
  table.in_degrees = true;
  for (std::size_t i = 0; i < model.coordinates.size(); ++i) {
    table.columns.push_back(model.coordinates[i].name);
    if (model.coordinates[i].rotation) table.values.col(static_cast<Eigen::Index>(i)) *= degrees(1);
  }
  return table;
}

}  // namespace gracilis::opensim
