#pragma once

#include <gracilis/geometry/polylines.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// One number per line, under a name that ParaView shows.
struct LineScalars {
  std::string name;
  std::vector<Real> values;
};

/// Writes lines as .vtp (m, double), whole or not at all. Throws InputError with the path and the reason.
void write_polylines(const std::filesystem::path& path, const Polylines& lines,
                     const std::vector<LineScalars>& scalars = {});

/// Reads the lines of a legacy .vtk, .vtp, .tck, .trk or .csv file; `unit` is the length of the file's unit in m. Cells
/// that meet end to end are joined, so a line stored segment by segment is one line; where three or more meet, lines
/// end. Lines come in the order of their first cells and run as most of their cells do. Of .tck, .trk and .csv files
/// each line is one. Throws InputError when the file cannot be read or holds no line of two points.
Polylines read_polylines(const std::filesystem::path& path, Real unit);

}  // namespace gracilis
