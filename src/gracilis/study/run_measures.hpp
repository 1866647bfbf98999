#pragma once

#include <gracilis/core/types.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// A column of a run's measures as the long table has it.
struct MetricName {
  std::string name, unit;  ///< "vertex_depth", "mm"; unit "1" where it has none
};
/// By the column's ending, as in "vertex_depth_mm".
MetricName metric_name(const std::string& column);

/// What a complete run measured: measures.csv, and mean fiber lengths where it followed fibers.
struct RunMeasures {
  std::vector<MetricName> metrics;
  std::vector<std::string> muscles;      ///< in the table's order
  std::vector<std::string> coordinates;  ///< columns of the pose, with their units
  struct Row {
    int frame = 0;
    std::size_t muscle = 0;
    Real time = 0;
    std::vector<std::string> pose;   ///< per coordinate, as the run wrote it
    std::vector<std::string> cells;  ///< per metric, as the run wrote it; empty where it is not measured
  };
  std::vector<Row> rows;
};

/// Throws InputError where the tables are missing, damaged, or not those that the run's list of hashes tells of.
RunMeasures read_run_measures(const std::filesystem::path& folder);

}  // namespace gracilis
