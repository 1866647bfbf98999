#include <gracilis/io/mesh/mesh_reader_vtk.hpp>

#include <gracilis/io/input_file.hpp>
#include <gracilis/io/text_cells.hpp>
#include <gracilis/io/value_reader.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace gracilis {

/// The type named by the next word.
static ScalarType read_type(ValueReader& reader) {
  static constexpr std::array<std::pair<std::string_view, ScalarType>, 13> types = {
      {{"char", ScalarType::int8},
       {"unsigned_char", ScalarType::uint8},
       {"short", ScalarType::int16},
       {"unsigned_short", ScalarType::uint16},
       {"int", ScalarType::int32},
       {"unsigned_int", ScalarType::uint32},
       {"long", ScalarType::int64},
       {"unsigned_long", ScalarType::uint64},
       {"vtktypeint64", ScalarType::int64},
       {"vtktypeuint64", ScalarType::uint64},
       {"vtkidtype", ScalarType::int32},
       {"float", ScalarType::float32},
       {"double", ScalarType::float64}}};
  const std::string name = lower_case(reader.word());
  for (const auto& [known, type] : types) {
    if (name == known) return type;
  }
  reader.fail(fmt::format("'{}' is not a number type of a .vtk file", name.substr(0, 40)));
}

/// Numbers begin on the line after their heading; in binary files exactly there.
static std::vector<double> read_numbers(std::size_t count, ScalarType type, Encoding encoding, ValueReader& reader) {
  reader.line();
  reader.encoding = encoding;
  std::vector<double> numbers;
  numbers.reserve(count);
  for (std::size_t i = 0; i < count; ++i) numbers.push_back(reader.number(type));
  reader.encoding = Encoding::text;
  return numbers;
}

/// Cells as lists of corners, in the old layout (size, corners, size, corners ...) or that of version 5 (offsets,
/// corners).
static std::vector<std::vector<std::int64_t>> read_cells(Encoding encoding, ValueReader& reader) {
  const std::size_t first = reader.count(reader.word());
  const std::size_t second = reader.count(reader.word());
  std::vector<std::vector<std::int64_t>> cells;
  const auto add_cell = [&](const std::vector<double>& numbers, double begin, double end) {
    if (!(begin >= 0 && begin <= end && end <= static_cast<double>(numbers.size()))) {
      reader.fail(fmt::format("cell {} has an impossible number of corners", cells.size()));
    }
    cells.emplace_back();
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      cells.back().push_back(std::abs(numbers[i]) < 1e15 ? static_cast<std::int64_t>(numbers[i]) : -1);
    }
  };

  reader.line();
  const bool version_5 = encoding == Encoding::text ? reader.word() == "OFFSETS" : reader.line().starts_with("OFFSETS");
  reader.unread_word();
  if (!version_5) {
    reader.encoding = encoding;
    std::vector<double> numbers;
    for (std::size_t i = 0; i < second; ++i) numbers.push_back(reader.number(ScalarType::int32));
    reader.encoding = Encoding::text;
    for (double i = 0; cells.size() < first; i += numbers[static_cast<std::size_t>(i)] + 1) {
      if (!(i < static_cast<double>(second))) reader.fail("has fewer cells than announced");
      add_cell(numbers, i + 1, i + 1 + numbers[static_cast<std::size_t>(i)]);
    }
    return cells;
  }
  reader.word();
  const std::vector<double> offsets = read_numbers(first, read_type(reader), encoding, reader);
  if (reader.word() != "CONNECTIVITY") reader.fail("CONNECTIVITY must follow OFFSETS");
  const std::vector<double> corners = read_numbers(second, read_type(reader), encoding, reader);
  for (std::size_t i = 0; i + 1 < offsets.size(); ++i) add_cell(corners, offsets[i], offsets[i + 1]);
  return cells;
}

static void skip_fields(Encoding encoding, ValueReader& reader) {
  reader.word();
  const std::size_t arrays = reader.count(reader.word());
  for (std::size_t i = 0; i < arrays; ++i) {
    reader.word();
    const std::size_t components = reader.count(reader.word());
    const std::size_t tuples = reader.count(reader.word(), std::max<std::size_t>(components, 1));
    read_numbers(components * tuples, read_type(reader), encoding, reader);
  }
}

static Encoding read_vtk_header(ValueReader& reader) {
  if (!reader.line().starts_with("# vtk DataFile"))
    reader.fail("is not a legacy .vtk file: '# vtk DataFile' is missing");
  reader.line();
  const std::string encoding = lower_case(reader.word());
  if (encoding != "ascii" && encoding != "binary") reader.fail("must say ASCII or BINARY in its third line");
  if (lower_case(reader.word()) != "dataset") reader.fail("names no DATASET");
  const std::string kind = lower_case(reader.word());
  if (kind != "polydata") {
    reader.fail(fmt::format("holds a data set of kind {}, not a surface", kind.substr(0, 40)), "export POLYDATA");
  }
  return encoding == "ascii" ? Encoding::text : Encoding::big_endian;
}

PolygonMesh read_legacy_vtk(const std::filesystem::path& path) {
  const std::string bytes = read_text(path);
  ValueReader reader(path, bytes);
  const Encoding encoding = read_vtk_header(reader);
  PolygonMesh mesh;
  for (;;) {
    const std::string keyword = lower_case(reader.word());
    if (keyword.empty() || keyword == "point_data" || keyword == "cell_data") return mesh;
    if (keyword == "points") {
      const std::size_t count = reader.count(reader.word(), 3);
      mesh.coordinates = read_numbers(3 * count, read_type(reader), encoding, reader);
    } else if (keyword == "polygons") {
      for (const std::vector<std::int64_t>& cell : read_cells(encoding, reader)) {
        mesh.corners.insert(mesh.corners.end(), cell.begin(), cell.end());
        mesh.end_polygon();
      }
    } else if (keyword == "triangle_strips") {
      for (const std::vector<std::int64_t>& cell : read_cells(encoding, reader)) mesh.add_strip(cell);
    } else if (keyword == "lines") {
      for (std::vector<std::int64_t>& cell : read_cells(encoding, reader)) mesh.lines.push_back(std::move(cell));
    } else if (keyword == "vertices") {
      read_cells(encoding, reader);
    } else if (keyword == "field") {
      skip_fields(encoding, reader);
    } else if (keyword == "metadata") {
      reader.line();
      while (!reader.at_end() && !reader.line().empty()) {
      }
    } else {
      reader.fail(fmt::format("'{}' is not a keyword of a surface", keyword.substr(0, 40)));
    }
  }
}

}  // namespace gracilis
