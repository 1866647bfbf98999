#include <gracilis/opensim/kinematics/coordinate_motion.hpp>

#include <gracilis/core/errors.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

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
  for (const Coupler& coupler : model.couplers) given[static_cast<std::size_t>(coupler.dependent)] = true;
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < given.size(); ++i)
    if (!given[i]) missing.push_back(model.coordinates[i].name);
  if (!missing.empty())
    motion.notes.push_back(
        fmt::format("{}: has no {}, which keep their default values", table.name, fmt::join(missing, ", ")));
  for (Eigen::Index row = 0; row < motion.values.rows(); ++row) {
    Eigen::VectorXd values = motion.values.row(row);
    apply_couplers(model, values);
    motion.values.row(row) = values;
  }
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
    Eigen::VectorXd values = motion.values.row(row);
    values[coordinate] = begin + std::copysign(step, end - begin) * static_cast<Real>(row);
    apply_couplers(model, values);
    motion.values.row(row) = values;
  }
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
