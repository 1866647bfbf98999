#include <gracilis/io/mesh/mesh_reader_vtp.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/mesh/vtp_arrays.hpp>
#include <gracilis/io/text_cells.hpp>
#include <gracilis/io/xml_text.hpp>

#include <fmt/format.h>

#include <pugixml.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>

namespace gracilis {

namespace {

constexpr const char* surface_remedy = "export the surface again";

[[noreturn]] void fail_in(const std::filesystem::path& path, const std::string& what, const std::string& where = "") {
  throw InputError({path.string(), where, what, surface_remedy});
}

}  // namespace

/// The file's text and its XML, which any number of readers share.
struct VtpFile::Text {
  explicit Text(const std::filesystem::path& path) : text(read_text(path)) {
    storage.path = path;
    parse();
  }

  /// Appended data may hold any bytes, so the XML is what stands before it.
  void parse() {
    const std::size_t begin = text.find("<AppendedData");
    std::string xml = text.substr(0, begin);
    if (begin != std::string::npos) {
      xml += "</VTKFile>";
      const std::size_t tag_end = std::min(text.find('>', begin), text.size());
      appended_base64 = text.substr(begin, tag_end - begin).find("base64") != std::string::npos;
      const std::size_t underscore = text.find('_', tag_end);
      if (underscore == std::string::npos) fail_in(storage.path, "has no appended data");
      appended = std::string_view(text).substr(underscore + 1);
    }
    parse_xml(storage.path, xml, "is damaged or no .vtp file", surface_remedy, document);
    root = document.child("VTKFile");
    if (std::strcmp(root.attribute("type").value(), "PolyData") != 0)
      fail_in(storage.path, "holds no surface: its type is not PolyData");
    storage.byte_order = std::strcmp(root.attribute("byte_order").value(), "BigEndian") == 0 ? Encoding::big_endian
                                                                                             : Encoding::little_endian;
    storage.header_type =
        std::strcmp(root.attribute("header_type").value(), "UInt64") == 0 ? ScalarType::uint64 : ScalarType::uint32;
    storage.compressor = root.attribute("compressor").value();
  }

  std::string text;
  VtpStorage storage;
  pugi::xml_document document;
  pugi::xml_node root;
  std::string_view appended;
  bool appended_base64 = false;
};

namespace {

/// Reads once.
class VtpReader {
 public:
  explicit VtpReader(const VtpFile::Text& file)
      : budget_(file.text.size()),
        storage_(file.storage),
        root_(file.root),
        appended_(file.appended),
        appended_base64_(file.appended_base64) {}

  PolygonMesh read() {
    for (const pugi::xml_node& piece : root_.child("PolyData").children("Piece")) read_piece(piece);
    return std::move(mesh_);
  }

  PolygonMesh read(const std::string& piece) {
    const pugi::xml_node found = named(piece);
    if (!found) fail("has no piece '" + piece + "'");
    read_piece(found);
    return std::move(mesh_);
  }

  bool has(const std::string& piece) const { return named(piece); }

  /// Of the first piece, where none is named. Empty when there is no such array.
  std::vector<double> read_point_data(const std::string& name, const std::string& piece) {
    const pugi::xml_node array = (piece.empty() ? root_.child("PolyData").child("Piece") : named(piece))
                                     .child("PointData")
                                     .find_child_by_attribute("DataArray", "Name", name.c_str());
    return array ? numbers(array, name) : std::vector<double>();
  }

  Points read_vectors(const std::string& name, const std::string& piece) {
    const std::vector<double> values = read_point_data(name, piece);
    if (values.size() % 3 != 0) fail("does not hold three numbers for each point", "array " + name);
    return Eigen::Map<const Points>(values.data(), 3, static_cast<Index>(values.size() / 3));
  }

  std::vector<double> read_field(const std::string& name) {
    const pugi::xml_node array =
        root_.child("PolyData").child("FieldData").find_child_by_attribute("DataArray", "Name", name.c_str());
    return array ? numbers(array, name) : std::vector<double>();
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& where = "") const {
    fail_in(storage_.path, what, where);
  }

  pugi::xml_node named(const std::string& piece) const {
    return root_.child("PolyData").find_child_by_attribute("Piece", "Name", piece.c_str());
  }

  ScalarType type_of(const pugi::xml_node& array, const std::string& name) const {
    static constexpr std::array<std::pair<std::string_view, ScalarType>, 10> types = {
        {{"Int8", ScalarType::int8},
         {"UInt8", ScalarType::uint8},
         {"Int16", ScalarType::int16},
         {"UInt16", ScalarType::uint16},
         {"Int32", ScalarType::int32},
         {"UInt32", ScalarType::uint32},
         {"Int64", ScalarType::int64},
         {"UInt64", ScalarType::uint64},
         {"Float32", ScalarType::float32},
         {"Float64", ScalarType::float64}}};
    for (const auto& [known, type] : types) {
      if (known == array.attribute("type").value()) return type;
    }
    fail("has numbers of an unknown type", "array " + name);
  }

  /// The array's numbers; `expected` of them where that is known.
  std::vector<double> numbers(const pugi::xml_node& array, const std::string& name,
                              std::optional<std::size_t> expected = {}) {
    if (!array) fail("is missing", "array " + name);
    const ScalarType type = type_of(array, name);
    const std::string_view format = array.attribute("format").value();
    if (format == "appended") {
      const auto offset = static_cast<std::size_t>(array.attribute("offset").as_ullong());
      if (array.attribute("offset").value()[0] == '-' || offset >= appended_.size())
        fail("begins after the end of the file", "array " + name);
      return decode_array(appended_.substr(offset), appended_base64_, type, storage_, name, expected, budget_);
    }
    const std::string_view content = trimmed(array.child_value());
    if (format == "binary") return decode_array(content, true, type, storage_, name, expected, budget_);
    std::vector<double> values;
    for (const std::string_view word : words_of(content)) {
      values.push_back(0);
      if (!parse_number(word, values.back()))
        fail(fmt::format("'{}' is not a number", word.substr(0, 40)), "array " + name);
    }
    return values;
  }

  /// Calls add(corners) for every cell of <Polys> or <Strips>; indices are made to count over all pieces.
  template <typename Add>
  void read_cells(const pugi::xml_node& cells, std::size_t count, std::size_t first_vertex, const Add& add) {
    if (count == 0) return;
    const auto named = [&](const char* name) { return cells.find_child_by_attribute("DataArray", "Name", name); };
    const std::vector<double> ends = numbers(named("offsets"), "offsets", count);
    const std::vector<double> corners = numbers(named("connectivity"), "connectivity");
    if (ends.size() != count) fail(fmt::format("has {} entries for {} faces", ends.size(), count), "array offsets");
    double begin = 0;
    for (const double end : ends) {
      if (!(end >= begin && end <= static_cast<double>(corners.size()))) {
        fail(fmt::format("leads from {} to {}, but there are {} corners", begin, end, corners.size()), "array offsets");
      }
      std::vector<std::int64_t> cell;
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
        const bool usable = corners[i] >= 0 && corners[i] < 1e15;
        cell.push_back(usable ? static_cast<std::int64_t>(corners[i]) + static_cast<std::int64_t>(first_vertex) : -1);
      }
      add(cell);
      begin = end;
    }
  }

  void read_piece(const pugi::xml_node& piece) {
    const auto count = [&](const char* name) {
      const std::string_view text = piece.attribute(name).value();
      Index number = 0;
      if (!text.empty() && !parse_index(text, number))
        fail(fmt::format("'{}' is not a count", text.substr(0, 40)), name);
      return static_cast<std::size_t>(number);
    };
    const std::size_t first_vertex = mesh_.coordinates.size() / 3;
    if (count("NumberOfPoints") > 0) {
      const pugi::xml_node points = piece.child("Points").child("DataArray");
      const std::vector<double> coordinates = numbers(points, "Points", 3 * count("NumberOfPoints"));
      if (coordinates.size() % 3 != 0 || coordinates.size() / 3 != count("NumberOfPoints")) {
        fail(fmt::format("has {} coordinates for {} points", coordinates.size(), count("NumberOfPoints")),
             "array Points");
      }
      mesh_.coordinates.insert(mesh_.coordinates.end(), coordinates.begin(), coordinates.end());
    }
    read_cells(piece.child("Polys"), count("NumberOfPolys"), first_vertex, [&](const std::vector<std::int64_t>& cell) {
      mesh_.corners.insert(mesh_.corners.end(), cell.begin(), cell.end());
      mesh_.end_polygon();
    });
    read_cells(piece.child("Strips"), count("NumberOfStrips"), first_vertex,
               [&](const std::vector<std::int64_t>& cell) { mesh_.add_strip(cell); });
    read_cells(piece.child("Lines"), count("NumberOfLines"), first_vertex,
               [&](const std::vector<std::int64_t>& cell) { mesh_.lines.push_back(cell); });
  }

  NumberBudget budget_;
  const VtpStorage& storage_;
  const pugi::xml_node root_;
  const std::string_view appended_;
  const bool appended_base64_;
  PolygonMesh mesh_;
};

}  // namespace

VtpFile::VtpFile(const std::filesystem::path& path) : text_(std::make_unique<const Text>(path)) {}
VtpFile::~VtpFile() = default;

std::size_t VtpFile::size() const { return text_->text.size(); }
const std::filesystem::path& VtpFile::path() const { return text_->storage.path; }
bool VtpFile::has(const std::string& piece) const { return VtpReader(*text_).has(piece); }
PolygonMesh VtpFile::read() const { return VtpReader(*text_).read(); }
PolygonMesh VtpFile::read(const std::string& piece) const { return VtpReader(*text_).read(piece); }
std::vector<double> VtpFile::field(const std::string& name) const { return VtpReader(*text_).read_field(name); }

Points VtpFile::vectors(const std::string& name, const std::string& piece) const {
  return VtpReader(*text_).read_vectors(name, piece);
}

Eigen::VectorXd VtpFile::scalars(const std::string& name, const std::string& piece) const {
  const std::vector<double> values = VtpReader(*text_).read_point_data(name, piece);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Index>(values.size()));
}

PolygonMesh read_vtp(const std::filesystem::path& path) { return VtpFile(path).read(); }

}  // namespace gracilis
