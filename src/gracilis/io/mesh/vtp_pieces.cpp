#include <gracilis/io/mesh/vtp_pieces.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/mesh/mesh_reader_vtp.hpp>

#include <fmt/format.h>

#include <vtkNew.h>
#include <vtkZLibDataCompressor.h>

#include <cstdint>
#include <map>

namespace gracilis {

namespace {

/// One array, compressed: VTK's header (blocks, size of a block, of a smaller last one, compressed sizes) and a block.
std::string packed(const void* data, std::size_t size) {
  if (size == 0) return std::string(12, '\0');
  vtkNew<vtkZLibDataCompressor> compressor;
  compressor->SetCompressionLevel(4);
  std::string block(compressor->GetMaximumCompressionSpace(size), '\0');
  const std::size_t used = compressor->Compress(static_cast<const unsigned char*>(data), size,
                                                reinterpret_cast<unsigned char*>(block.data()), block.size());
  const std::uint32_t header[] = {1, static_cast<std::uint32_t>(size), 0, static_cast<std::uint32_t>(used)};
  return std::string(reinterpret_cast<const char*>(header), sizeof header) + block.substr(0, used);
}

template <class Number>
std::string packed(const std::vector<Number>& numbers) {
  return packed(numbers.data(), numbers.size() * sizeof(Number));
}

/// The arrays of one piece.
struct PackedPiece {
  std::string points, part, corners, ends;
  std::vector<std::string> arrays;
};

PackedPiece packed(const VtpPiece& piece, std::int32_t number) {
  PackedPiece result;
  result.points = packed(piece.points.data(), static_cast<std::size_t>(piece.points.size()) * sizeof(double));
  for (const VertexArray& array : piece.arrays)
    result.arrays.push_back(
        packed(array.values.data(), static_cast<std::size_t>(array.values.size()) * sizeof(double)));
  std::vector<std::int32_t> corners, ends;
  if (piece.faces.cols() > 0) {
    corners.assign(piece.faces.data(), piece.faces.data() + piece.faces.size());
    for (Eigen::Index i = 1; i <= piece.faces.cols(); ++i) ends.push_back(static_cast<std::int32_t>(3 * i));
  } else {
    for (Eigen::Index i = 0; i < piece.points.cols(); ++i) corners.push_back(static_cast<std::int32_t>(i));
    ends.assign(piece.line_offsets.begin() + 1, piece.line_offsets.end());
  }
  result.corners = packed(corners);
  result.part = packed(std::vector<std::int32_t>(ends.size(), number));
  result.ends = packed(ends);
  return result;
}

/// What stands behind the XML; the same bytes once.
class AppendedData {
 public:
  std::size_t add(std::string bytes) {
    const auto [found, is_new] = offsets_.emplace(std::move(bytes), text_.size());
    if (is_new) text_ += found->first;
    return found->second;
  }
  const std::string& text() const { return text_; }

 private:
  std::map<std::string, std::size_t> offsets_;
  std::string text_;
};

std::string array_text(const char* type, const std::string& name, Eigen::Index components, std::size_t offset,
                       const std::string& more = "") {
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"{} format=\"appended\" offset=\"{}\"/>", type, name,
      components, more, offset);
}

std::string piece_text(const VtpPiece& piece, PackedPiece&& packed, AppendedData& data) {
  const Eigen::Index faces = piece.faces.cols(),
                     lines = faces > 0 ? 0 : static_cast<Eigen::Index>(piece.line_offsets.size()) - 1;
  std::string text =
      fmt::format("<Piece Name=\"{}\" NumberOfPoints=\"{}\" NumberOfLines=\"{}\" NumberOfPolys=\"{}\">\n", piece.name,
                  piece.points.cols(), lines, faces);
  text += "<PointData>";
  for (std::size_t i = 0; i < piece.arrays.size(); ++i)
    text +=
        array_text("Float64", piece.arrays[i].name, piece.arrays[i].components, data.add(std::move(packed.arrays[i])));
  text += "</PointData><CellData>" + array_text("Int32", "part", 1, data.add(std::move(packed.part))) + "</CellData>\n";
  text += "<Points>" + array_text("Float64", "Points", 3, data.add(std::move(packed.points))) + "</Points>";
  const char* cells = faces > 0 ? "Polys" : "Lines";
  text += fmt::format("<{0}>{1}{2}</{0}></Piece>\n", cells,
                      array_text("Int32", "connectivity", 1, data.add(std::move(packed.corners))),
                      array_text("Int32", "offsets", 1, data.add(std::move(packed.ends))));
  return text;
}

}  // namespace

void write_vtp_pieces(const std::filesystem::path& path, const std::vector<VtpPiece>& pieces,
                      const std::vector<VtpField>& fields) {
  std::vector<PackedPiece> arrays(pieces.size());
  parallel_for_each(pieces.size(), [&](std::size_t i) { arrays[i] = packed(pieces[i], static_cast<std::int32_t>(i)); });
  AppendedData data;
  std::string text =
      "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\" header_type=\"UInt32\" "
      "compressor=\"vtkZLibDataCompressor\">\n<PolyData>\n<FieldData>";
  for (const auto& [name, values] : fields)
    text += array_text("Float64", name, 1,
                       data.add(packed(values.data(), static_cast<std::size_t>(values.size()) * sizeof(double))),
                       fmt::format(" NumberOfTuples=\"{}\"", values.size()));
  text += "</FieldData>\n";
  for (std::size_t i = 0; i < pieces.size(); ++i) text += piece_text(pieces[i], std::move(arrays[i]), data);
  text += "</PolyData>\n<AppendedData encoding=\"raw\">\n_" + data.text() + "\n</AppendedData>\n</VTKFile>\n";
  write_text_atomically(path, text);
}

TriangleMesh read_vtp_piece(const VtpFile& file, const std::string& piece) {
  return triangulated(file.read(piece), 1, file.path());
}

Polylines read_vtp_lines(const std::filesystem::path& path, const std::string& piece) {
  const auto fail = [&](const std::string& what) {
    throw InputError({path.string(), piece, what, "run the scene again"});
  };
  const VtpFile file(path);
  if (!file.has(piece)) return {};
  const PolygonMesh mesh = file.read(piece);
  Polylines lines;
  lines.points = Eigen::Map<const Points>(mesh.coordinates.data(), 3, static_cast<Index>(mesh.coordinates.size() / 3));
  if (!lines.points.allFinite()) fail("has a point that is not finite");
  for (const std::vector<std::int64_t>& line : mesh.lines) {
    if (line.size() < 2) fail(fmt::format("has a line of {} points; two are the fewest", line.size()));
    std::int64_t next = lines.offsets.back();
    for (const std::int64_t point : line)
      if (point != next++) fail("has lines that do not go through its points in turn");
    lines.offsets.push_back(static_cast<Index>(next));
  }
  if (lines.offsets.back() != lines.points.cols()) fail("has lines that do not go through its points in turn");
  return lines;
}

}  // namespace gracilis
