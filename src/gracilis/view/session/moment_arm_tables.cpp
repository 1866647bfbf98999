#include <gracilis/view/session/moment_arm_tables.hpp>

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/tables/action_tables.hpp>
#include <gracilis/simulate/moment_arms.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace gracilis {

Eigen::VectorXd values_of(const Table& table, const MovedCoordinate& moved) {
  return table.values.col(column_of(table, moved.name).value()) * (moved.translation ? 1 : radians(1));
}

Table rows_of_range(Table table, const Scene& scene) {
  const auto rows = std::min(static_cast<Eigen::Index>(scene.motion.times.size()), table.values.rows());
  table.values = table.values.bottomRows(rows).eval();
  table.times.erase(table.times.begin(), table.times.end() - rows);
  table.name = "moment_arms";
  return table;
}

std::vector<std::vector<Index>> lines_along(const Table& table, const Scene& scene, const MovedCoordinate& moved) {
  std::vector<Eigen::Index> others;
  for (const std::string& name : coordinate_names(scene))
    if (const auto column = column_of(table, name); column && name != moved.name) others.push_back(*column);
  std::map<std::vector<Real>, std::size_t> known;
  std::vector<std::vector<Index>> lines;
  for (Index row = 0; row < static_cast<Index>(table.values.rows()); ++row) {
    std::vector<Real> place;
    for (const Eigen::Index column : others) place.push_back(table.values(row, column));
    const auto [line, is_new] = known.emplace(std::move(place), lines.size());
    if (is_new) lines.emplace_back();
    lines[line->second].push_back(row);
  }
  return lines;
}

Table moment_arm_table(const std::filesystem::path& folder, const Scene& scene, const MovedCoordinate& moved) {
  if (const auto known = folder / moment_arm_file(moved.name, coordinate_names(scene)); is_there(known))
    return rows_of_range(read_table(known), scene);
  Table table = rows_of_range(read_table(folder / "fiber_lengths.sto"), scene);
  const auto coordinates = static_cast<Eigen::Index>(coordinate_names(scene).size());
  const auto columns = Eigen::seq(coordinates, Eigen::last);
  const Eigen::VectorXd values = values_of(table, moved);
  for (const std::vector<Index>& line : lines_along(table, scene, moved))
    table.values(line, columns) = moment_arms(values(line), table.values(line, columns)).eval();
  return table;
}

std::string doubtful_text(const Table& table, const std::string& muscle) {
  const std::optional<Eigen::Index> column = column_of(table, muscle + "_doubtful");
  if (!column) return "";
  const Eigen::VectorXd counts = table.values.col(*column);
  if (counts.isZero(0)) return "";
  return fmt::format("  at most {:.0f} fibers, in {} of {} poses, are near a snap or not at rest", counts.maxCoeff(),
                     (counts.array() > 0).count(), counts.size());
}

}  // namespace gracilis
