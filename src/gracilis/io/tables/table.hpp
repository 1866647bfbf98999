#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/scene/scene.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gracilis {

/// A table over time as OpenSim's .mot and .sto files hold it, in the file's own units.
struct Table {
  std::string name;
  std::vector<std::string> columns;   ///< without the time
  std::vector<Real> times;            ///< s, increasing, one per row
  Eigen::MatrixXd values;             ///< rows × columns
  bool in_degrees = false;            ///< of columns that are angles
  std::vector<std::string> warnings;  ///< what was wrong with the file but could be survived; one sentence each
};

/// Number of the column of that name.
std::optional<Eigen::Index> column_of(const Table& table, const std::string& name);

/// Reads a .mot, .sto or .csv: headers as OpenSim up to 3 writes them (name, version=, nRows=, nColumns=, inDegrees=),
/// as SIMM does (name, datacolumns, datarows, range), as OpenSim 4 does (DataType=, OpenSimVersion=), or none at all;
/// columns between tabs, spaces or commas, in any order. Survived with a warning: wrong row and column counts, a
/// missing inDegrees (radians; degrees under a SIMM header); a time that is repeated or a column of a name that was
/// there before (the first one counts); columns with several numbers in a cell, as OpenSim writes quaternions (left
/// out); no column beside the time. Survived in silence: blank lines, separators at the ends of lines, `\r\n`, a byte
/// order mark. Throws InputError with file and line: no header end, no column "time", rows of a wrong length, cells
/// that are not finite numbers, times that decrease, no rows.
Table read_table(const std::filesystem::path& path);

/// Writes a table with the header that OpenSim 4 reads (version 1, inDegrees), whole or not at all. Throws
/// QualityError, which names column and row, where a number is not finite.
void write_sto(const std::filesystem::path& path, const Table& table);

/// Writes the columns as comma-separated values of 12 digits, without the times, whole or not at all. Throws as
/// write_sto does.
void write_csv(const std::filesystem::path& path, const Table& table);

/// The coordinate that a column holds: the column's name, cut from OpenSim's state names
/// (/jointset/hip_r/hip_flexion_r/value); empty for other states.
std::string coordinate_of_column(const std::string& column);

/// The coordinates of a motion in rad. Columns named in `translations` are in m in any table and stay as they are;
/// other translations (names that end in _tx, _ty, _tz or Translation) and speeds are left out.
Motion motion_from_table(const Table& table, const std::vector<std::string>& translations = {});

}  // namespace gracilis
