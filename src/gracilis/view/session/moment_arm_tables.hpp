#pragma once

#include <gracilis/io/tables/table.hpp>
#include <gracilis/scene/scene.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// A coordinate that a run through ranges of motion moved.
struct MovedCoordinate {
  std::string name;
  bool translation = false;
};

/// The coordinate's values in a table, which has degrees and m, in rad or m.
Eigen::VectorXd values_of(const Table& table, const MovedCoordinate& moved);

/// The rows of a run's table that belong to the scene's motion: not those that led there.
Table rows_of_range(Table table, const Scene& scene);

/// The rows of a table between which `moved` alone changes, of all coordinates of the scene: one list for each
/// combination of the others' values, in the table's order. With a table of one range, all rows.
std::vector<std::vector<Index>> lines_along(const Table& table, const Scene& scene, const MovedCoordinate& moved);

/// A run's moment arms about the coordinate: those that its method knows, or else what lengths say along each of the
/// lines (moment_arms). Every coordinate has a column, then every muscle and fiber. Throws InputError.
Table moment_arm_table(const std::filesystem::path& folder, const Scene& scene, const MovedCoordinate& moved);

/// The most fibers of a muscle in a pose that are about to snap to another way or not at rest, and in how many poses
/// any are: a line for people, or nothing.
std::string doubtful_text(const Table& table, const std::string& muscle);

}  // namespace gracilis
