#pragma once

#include <gracilis/io/tables/run_table.hpp>
#include <gracilis/io/tables/table.hpp>

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

namespace gracilis {

/// A run's table of one row as readers see it, who must find nothing wrong with it.
inline Table read_back(const RunTable& table) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / ("gracilis_" + table.name);
  std::ofstream(path) << table.head << table.row;
  const Table read = read_table(path);
  std::filesystem::remove(path);
  EXPECT_THAT(read.warnings, testing::IsEmpty());
  return read;
}

/// The row's number in a column that is there.
inline Real value(const Table& table, const std::string& column) {
  return table.values(0, column_of(table, column).value());
}

}  // namespace gracilis
