#include <gracilis/io/mesh/mesh_reader_obj.hpp>

#include <gracilis/io/input_file.hpp>
#include <gracilis/io/value_reader.hpp>

#include <fmt/format.h>

#include <string>

namespace gracilis {

/// "3/1/2" is vertex 2 counted from 0; negative numbers count back from the last vertex read.
static std::int64_t corner(std::string_view text, std::size_t vertex_count, const ValueReader& reader) {
  long long number = 0;
  if (!parse_integer(text.substr(0, text.find('/')), number) || number == 0) {
    reader.fail(fmt::format("'{}' is not a corner of a face", text.substr(0, 40)));
  }
  return number > 0 ? number - 1 : static_cast<std::int64_t>(vertex_count) + number;
}

PolygonMesh read_obj(const std::filesystem::path& path) {
  std::string text = read_text(path);
  // A backslash at the end of a line continues it; spaces keep the bytes' positions and with them the line numbers
  // nearly.
  for (std::size_t i = 0; (i = text.find("\\\n", i)) != std::string::npos;) text.replace(i, 2, "  ");
  ValueReader reader(path, text);
  PolygonMesh mesh;
  while (!reader.at_end()) {
    const std::string_view line = reader.line();
    ValueReader words(path, line);
    const std::string_view keyword = words.word();
    if (keyword == "v") {
      for (int i = 0; i < 3; ++i) {
        const std::string_view word = words.word();
        double value = 0;
        if (!parse_number(word, value)) reader.fail(fmt::format("'{}' is not a coordinate", word.substr(0, 40)));
        mesh.coordinates.push_back(value);
      }
    } else if (keyword == "f") {
      for (std::string_view word = words.word(); !word.empty() && word[0] != '#'; word = words.word()) {
        mesh.corners.push_back(corner(word, mesh.coordinates.size() / 3, reader));
      }
      mesh.end_polygon();
    } else if (keyword == "l") {
      mesh.lines.emplace_back();
    }
  }
  return mesh;
}

}  // namespace gracilis
