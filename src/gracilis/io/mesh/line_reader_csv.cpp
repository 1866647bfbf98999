#include <gracilis/io/mesh/line_reader_csv.hpp>

#include <gracilis/io/csv_rows.hpp>
#include <gracilis/io/input_file.hpp>

#include <array>
#include <optional>
#include <string>

namespace gracilis {

/// The column of a coordinate, and the length of its unit.
static std::pair<std::size_t, Real> coordinate_column(const CsvRows& rows, const std::string& axis, Real unit) {
  if (const std::optional<std::size_t> column = rows.column(axis + "_mm")) return {*column, 0.001};
  if (const std::optional<std::size_t> column = rows.column(axis)) return {*column, unit};
  rows.fail("has no column '" + axis + "_mm' or '" + axis + "'", "name the columns tract, x_mm, y_mm, z_mm");
}

Polylines read_csv_lines(const std::filesystem::path& path, Real unit) {
  const std::string text = read_text(path);
  CsvRows rows(path, text);
  std::optional<std::size_t> tract = rows.column("tract");
  if (!tract) tract = rows.column("line");
  if (!tract) rows.fail("has no column 'tract'", "name the columns tract, x_mm, y_mm, z_mm");
  const std::array<std::pair<std::size_t, Real>, 3> columns = {
      coordinate_column(rows, "x", unit), coordinate_column(rows, "y", unit), coordinate_column(rows, "z", unit)};
  std::vector<Real> coordinates;
  std::vector<Index> ends;
  std::string name;
  while (rows.next()) {
    const std::string_view cell = rows.cell(*tract);
    if (cell.empty()) rows.fail("names no tract");
    if (!coordinates.empty() && cell != name) ends.push_back(static_cast<Index>(coordinates.size() / 3));
    name = cell;
    for (const auto& [column, length] : columns) coordinates.push_back(length * rows.number(column, "a coordinate"));
  }
  ends.push_back(static_cast<Index>(coordinates.size() / 3));
  std::vector<Points> lines;
  Index begin = 0;
  for (const Index end : ends) {
    if (end - begin >= 2) lines.emplace_back(Eigen::Map<const Points>(coordinates.data() + 3 * begin, 3, end - begin));
    begin = end;
  }
  return join(lines);
}

}  // namespace gracilis
