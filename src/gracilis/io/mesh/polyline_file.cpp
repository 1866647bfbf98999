#include <gracilis/io/mesh/polyline_file.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/mesh/line_reader_csv.hpp>
#include <gracilis/io/mesh/line_reader_tck.hpp>
#include <gracilis/io/mesh/line_reader_trk.hpp>
#include <gracilis/io/mesh/mesh_reader_vtk.hpp>
#include <gracilis/io/mesh/mesh_reader_vtp.hpp>
#include <gracilis/io/mesh/polygon_mesh.hpp>
#include <gracilis/io/mesh/vtk_mesh.hpp>
#include <gracilis/io/mesh/vtk_writing.hpp>

#include <fmt/format.h>

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>

namespace gracilis {

namespace fs = std::filesystem;

void write_polylines(const fs::path& path, const Polylines& lines, const std::vector<LineScalars>& scalars) {
  const vtkSmartPointer<vtkPolyData> data = to_vtk(lines);
  for (const LineScalars& each : scalars) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(each.name.c_str());
    for (const Real value : each.values) array->InsertNextValue(value);
    data->GetCellData()->AddArray(array);
  }
  vtkNew<vtkXMLPolyDataWriter> writer;
  write_by_vtk(path, *writer, *data);
}

namespace {

using Cell = std::vector<std::int64_t>;

/// Joins cells that meet end to end at points where exactly two ends meet.
std::vector<Cell> joined(const std::vector<Cell>& cells, std::size_t point_count) {
  std::vector<std::vector<std::size_t>> ends_at(point_count);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    ends_at[static_cast<std::size_t>(cells[c].front())].push_back(c);
    ends_at[static_cast<std::size_t>(cells[c].back())].push_back(c);
  }
  std::vector<char> used(cells.size(), 0);
  // The unused cell that goes on from this point, or none.
  const auto next = [&](std::int64_t point) {
    const auto& ends = ends_at[static_cast<std::size_t>(point)];
    if (ends.size() == 2)
      for (const std::size_t c : ends)
        if (!used[c]) return c;
    return cells.size();
  };
  std::vector<Cell> lines;
  for (std::size_t first = 0; first < cells.size(); ++first) {
    if (used[first]) continue;
    used[first] = 1;
    std::deque<std::int64_t> line(cells[first].begin(), cells[first].end());
    for (std::size_t c = next(line.back()); c < cells.size(); c = next(line.back())) {
      used[c] = 1;
      Cell cell = cells[c];
      if (cell.front() != line.back()) std::reverse(cell.begin(), cell.end());
      line.insert(line.end(), cell.begin() + 1, cell.end());
    }
    for (std::size_t c = next(line.front()); c < cells.size(); c = next(line.front())) {
      used[c] = 1;
      Cell cell = cells[c];
      if (cell.back() != line.front()) std::reverse(cell.begin(), cell.end());
      line.insert(line.begin(), cell.begin(), cell.end() - 1);
    }
    lines.emplace_back(line.begin(), line.end());
  }
  return lines;
}

PolygonMesh read_cells(const fs::path& path) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".vtk") return read_legacy_vtk(path);
  if (extension == ".vtp") return read_vtp(path);
  throw InputError({path.string(), "", fmt::format("'{}' is not a format that lines can be read from", extension),
                    "use .vtk, .vtp, .tck, .trk or .csv"});
}

/// Lines of a format that holds nothing but lines; none for the others.
std::optional<Polylines> read_whole_lines(const fs::path& path, Real unit) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".tck") return read_tck(path, unit);
  if (extension == ".trk") return read_trk(path, unit);
  if (extension == ".csv") return read_csv_lines(path, unit);
  return std::nullopt;
}

}  // namespace

Polylines read_polylines(const fs::path& path, Real unit) {
  require_readable_file(path);
  if (std::optional<Polylines> whole = read_whole_lines(path, unit)) {
    if (whole->count() == 0) throw InputError({path.string(), "", "holds no lines", "export it again"});
    return std::move(*whole);
  }
  const PolygonMesh mesh = read_cells(path);
  const auto fail = [&](const std::string& what) { throw InputError({path.string(), "", what, "export it again"}); };
  const std::size_t count = mesh.coordinates.size() / 3;
  std::vector<Cell> cells;
  for (const Cell& cell : mesh.lines) {
    for (const std::int64_t point : cell) {
      if (point < 0 || point >= static_cast<std::int64_t>(count))
        fail(fmt::format("a line names point {}, but the points go from 0 to {}", point, count - 1));
      for (std::size_t k = 0; k < 3; ++k)
        if (!std::isfinite(mesh.coordinates[3 * static_cast<std::size_t>(point) + k]))
          fail(fmt::format("point {} is not finite", point));
    }
    if (cell.size() >= 2) cells.push_back(cell);
  }
  if (cells.empty()) fail("holds no lines");
  std::vector<Points> lines;
  for (const Cell& line : joined(cells, count)) {
    Points points(3, static_cast<Index>(line.size()));
    for (std::size_t i = 0; i < line.size(); ++i)
      points.col(static_cast<Index>(i)) =
          unit * Eigen::Map<const Vec3>(mesh.coordinates.data() + 3 * static_cast<std::size_t>(line[i]));
    lines.push_back(std::move(points));
  }
  return join(lines);
}

}  // namespace gracilis
