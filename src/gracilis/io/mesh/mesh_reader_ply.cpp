#include <gracilis/io/mesh/mesh_reader_ply.hpp>

#include <gracilis/io/input_file.hpp>
#include <gracilis/io/value_reader.hpp>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace gracilis {

namespace {

struct Property {
  std::string name;
  ScalarType type{};
  std::optional<ScalarType> count_type;  ///< set for a list
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

}  // namespace

static ScalarType scalar_type(std::string_view name, const ValueReader& reader) {
  static constexpr std::array<std::pair<std::string_view, ScalarType>, 16> types = {{{"char", ScalarType::int8},
                                                                                     {"int8", ScalarType::int8},
                                                                                     {"uchar", ScalarType::uint8},
                                                                                     {"uint8", ScalarType::uint8},
                                                                                     {"short", ScalarType::int16},
                                                                                     {"int16", ScalarType::int16},
                                                                                     {"ushort", ScalarType::uint16},
                                                                                     {"uint16", ScalarType::uint16},
                                                                                     {"int", ScalarType::int32},
                                                                                     {"int32", ScalarType::int32},
                                                                                     {"uint", ScalarType::uint32},
                                                                                     {"uint32", ScalarType::uint32},
                                                                                     {"float", ScalarType::float32},
                                                                                     {"float32", ScalarType::float32},
                                                                                     {"double", ScalarType::float64},
                                                                                     {"float64", ScalarType::float64}}};
  for (const auto& [known, type] : types) {
    if (name == known) return type;
  }
  reader.fail(fmt::format("'{}' is not a type of a .ply file", name.substr(0, 40)));
}

static Encoding encoding_named(std::string_view name, const ValueReader& reader) {
  if (name == "ascii") return Encoding::text;
  if (name == "binary_little_endian") return Encoding::little_endian;
  if (name == "binary_big_endian") return Encoding::big_endian;
  reader.fail(fmt::format("'{}' is not a format of a .ply file", name.substr(0, 40)));
}

/// Reads up to and including the line "end_header"; `encoding` of the reader then is the body's.
static std::vector<Element> read_ply_header(ValueReader& reader) {
  if (reader.line() != "ply") reader.fail("is not a .ply file: the first line must be 'ply'");
  std::vector<Element> elements;
  Encoding encoding = Encoding::text;
  for (;;) {
    const std::string_view keyword = reader.word();
    if (keyword.empty()) reader.fail("the header has no end");
    if (keyword == "end_header") break;
    if (keyword == "format") {
      encoding = encoding_named(reader.word(), reader);
    } else if (keyword == "element") {
      Element element;
      element.name = reader.word();
      element.count = reader.count(reader.word());
      elements.push_back(element);
    } else if (keyword == "property") {
      if (elements.empty()) reader.fail("a property stands before any element");
      Property property;
      std::string_view type = reader.word();
      if (type == "list") {
        property.count_type = scalar_type(reader.word(), reader);
        type = reader.word();
      }
      property.type = scalar_type(type, reader);
      property.name = reader.word();
      elements.back().properties.push_back(property);
    } else if (keyword != "comment" && keyword != "obj_info") {
      reader.fail(fmt::format("'{}' does not belong in the header of a .ply file", keyword.substr(0, 40)));
    }
    reader.line();
  }
  reader.line();
  reader.encoding = encoding;
  return elements;
}

static void read_list(const Property& property, bool wanted, ValueReader& reader, PolygonMesh& mesh) {
  const double size = reader.number(*property.count_type);
  if (!(size >= 0) || size != std::floor(size)) reader.fail(fmt::format("a list cannot have {} entries", size));
  for (double i = 0; i < size; ++i) {
    const double value = reader.number(property.type);
    if (wanted) mesh.corners.push_back(std::abs(value) < 1e15 ? static_cast<std::int64_t>(value) : -1);
  }
}

static void read_element(const Element& element, ValueReader& reader, PolygonMesh& mesh) {
  const bool vertices = element.name == "vertex";
  const bool faces = element.name == "face";
  for (std::size_t i = 0; i < element.count; ++i) {
    std::array<double, 3> point{};
    for (const Property& property : element.properties) {
      if (property.count_type) {
        read_list(property, faces && (property.name == "vertex_indices" || property.name == "vertex_index"), reader,
                  mesh);
        continue;
      }
      const double value = reader.number(property.type);
      if (property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z') {
        point[static_cast<std::size_t>(property.name[0] - 'x')] = value;
      }
    }
    if (vertices) mesh.coordinates.insert(mesh.coordinates.end(), point.begin(), point.end());
    if (faces) mesh.end_polygon();
  }
}

PolygonMesh read_ply(const std::filesystem::path& path) {
  const std::string bytes = read_text(path);
  ValueReader reader(path, bytes);
  PolygonMesh mesh;
  for (const Element& element : read_ply_header(reader)) {
    if (element.count > 0 && element.properties.empty())
      reader.fail("element '" + element.name + "' has no properties");
    read_element(element, reader, mesh);
  }
  return mesh;
}

}  // namespace gracilis
