#include <gracilis/io/mesh/line_reader_tck.hpp>

#include <gracilis/io/input_file.hpp>
#include <gracilis/io/value_reader.hpp>

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace gracilis {

namespace {

struct TckHeader {
  ScalarType type = ScalarType::float32;
  Encoding encoding = Encoding::text;  ///< text: not said
  std::size_t offset = 0;
};

void take_tck_type(std::string_view value, const ValueReader& reader, TckHeader& header) {
  const bool is_known = value.size() == 9 && value.starts_with("Float") &&
                        (value.substr(5, 2) == "32" || value.substr(5, 2) == "64") &&
                        (value.ends_with("LE") || value.ends_with("BE"));
  if (!is_known) reader.fail(fmt::format("'{}' is not a data type of a .tck file", value.substr(0, 40)));
  header.type = value.substr(5, 2) == "32" ? ScalarType::float32 : ScalarType::float64;
  header.encoding = value.ends_with("LE") ? Encoding::little_endian : Encoding::big_endian;
}

TckHeader read_tck_header(ValueReader& reader, std::size_t size) {
  if (reader.line() != "mrtrix tracks") reader.fail("is not a .tck file: the first line must be 'mrtrix tracks'");
  TckHeader header;
  for (;;) {
    if (reader.at_end()) reader.fail("the header has no 'END'");
    const std::string_view key = reader.word();
    if (key == "END") break;
    if (key == "datatype:") take_tck_type(reader.word(), reader, header);
    if (key == "file:") {
      if (reader.word() != ".") reader.fail("the tracks stand in another file", "export them into one file");
      long long offset = 0;
      if (!parse_integer(reader.word(), offset) || offset <= 0) reader.fail("does not say where the tracks begin");
      header.offset = static_cast<std::size_t>(offset);
    }
    reader.line();
  }
  if (header.encoding == Encoding::text) reader.fail("the header has no 'datatype:'");
  if (header.offset == 0 || header.offset >= size)
    reader.fail(fmt::format("the tracks begin at byte {}, but the file has {}", header.offset, size));
  return header;
}

}  // namespace

Polylines read_tck(const std::filesystem::path& path, Real unit) {
  const std::string bytes = read_text(path);
  ValueReader head(path, bytes);
  const TckHeader header = read_tck_header(head, bytes.size());
  ValueReader reader(path, std::string_view(bytes).substr(header.offset));
  reader.encoding = header.encoding;
  std::vector<Points> lines;
  std::vector<Real> line;
  for (bool is_end = false; !is_end;) {
    Vec3 point;
    for (Real& x : point) x = reader.number(header.type);
    is_end = point.array().isInf().all();
    if (point.allFinite()) {
      for (const Real x : point) line.push_back(unit * x);
      continue;
    }
    if (!is_end && !point.array().isNaN().all()) reader.fail("a point is not finite");
    if (line.size() >= 6) lines.emplace_back(Eigen::Map<const Points>(line.data(), 3, Index(line.size() / 3)));
    line.clear();
  }
  return join(lines);
}

}  // namespace gracilis
