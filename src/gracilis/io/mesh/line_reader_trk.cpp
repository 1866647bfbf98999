#include <gracilis/io/mesh/line_reader_trk.hpp>

#include <gracilis/io/input_file.hpp>
#include <gracilis/io/value_reader.hpp>

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cmath>
#include <string>

namespace gracilis {

namespace {

constexpr std::size_t trk_header_size = 1000;

/// Numbers of a header, by the byte at which they stand.
class TrkHeader {
 public:
  TrkHeader(const std::filesystem::path& path, std::string_view bytes) : path_(path), bytes_(bytes) {
    const ValueReader whole(path, bytes);
    if (!bytes.starts_with("TRACK")) whole.fail("is not a .trk file: it must begin with 'TRACK'");
    if (bytes.size() < trk_header_size) whole.fail("ends within its header of 1000 bytes");
    for (const Encoding each : {Encoding::little_endian, Encoding::big_endian}) {
      encoding = each;
      if (number(996, ScalarType::int32) == trk_header_size) return;
    }
    whole.fail("its header does not say that it has 1000 bytes");
  }

  Real number(std::size_t at, ScalarType type) const {
    ValueReader reader(path_, bytes_.substr(at));
    reader.encoding = encoding;
    return reader.number(type);
  }
  std::string_view text(std::size_t at, std::size_t size) const { return bytes_.substr(at, size); }

  Encoding encoding = Encoding::little_endian;

 private:
  std::filesystem::path path_;
  std::string_view bytes_;
};

/// Which axis of the scanner's frame a letter names, and whether it runs the other way: L and R, P and A, I and S.
std::pair<int, bool> axis_of_letter(char letter) {
  const std::string_view letters = "LRPAIS";
  const std::size_t at = letters.find(static_cast<char>(std::toupper(static_cast<unsigned char>(letter))));
  if (at == std::string_view::npos) return {-1, false};
  return {static_cast<int>(at / 2), at % 2 == 0};
}

/// From voxels in the order of `letters` to voxels in that of the matrix, whose axes may run in another order and
/// the other way.
Eigen::Matrix4d reordered(const Eigen::Matrix4d& to_scanner, std::string_view letters, const Vec3& dimensions) {
  Eigen::Matrix4d result = Eigen::Matrix4d::Zero();
  result(3, 3) = 1;
  std::array<bool, 3> is_taken{};
  for (int column = 0; column < 3; ++column) {
    int axis = 0;
    to_scanner.col(column).head<3>().cwiseAbs().maxCoeff(&axis);
    const bool is_negative = to_scanner(axis, column) < 0;
    for (int k = 0; k < 3; ++k) {
      const auto [named, is_turned] = axis_of_letter(letters[static_cast<std::size_t>(k)]);
      if (named != axis || is_taken[static_cast<std::size_t>(k)]) continue;
      is_taken[static_cast<std::size_t>(k)] = true;
      result(column, k) = is_turned == is_negative ? 1 : -1;
      if (is_turned != is_negative) result(column, 3) = dimensions[k] - 1;
      break;
    }
  }
  const bool is_complete = is_taken[0] && is_taken[1] && is_taken[2];
  return is_complete ? result : Eigen::Matrix4d(Eigen::Matrix4d::Identity());
}

/// From a track's numbers to mm.
Eigen::Matrix4d trk_transform(const TrkHeader& header) {
  Eigen::Matrix4d to_scanner;
  Vec3 voxel, dimensions;
  for (int i = 0; i < 16; ++i)
    to_scanner(i / 4, i % 4) = header.number(440 + 4 * static_cast<std::size_t>(i), ScalarType::float32);
  for (int k = 0; k < 3; ++k) {
    dimensions[k] = header.number(6 + 2 * static_cast<std::size_t>(k), ScalarType::int16);
    voxel[k] = header.number(12 + 4 * static_cast<std::size_t>(k), ScalarType::float32);
  }
  const bool is_given = header.number(992, ScalarType::int32) >= 2 && to_scanner(3, 3) == 1 && to_scanner.allFinite() &&
                        std::abs(to_scanner.determinant()) > 0 && voxel.allFinite() && voxel.minCoeff() > 0;
  if (!is_given) return Eigen::Matrix4d::Identity();
  // The first voxel's middle is at half a voxel.
  Eigen::Matrix4d to_voxels = Eigen::Matrix4d::Identity();
  for (int k = 0; k < 3; ++k) to_voxels(k, k) = 1 / voxel[k], to_voxels(k, 3) = -0.5;
  const std::string_view letters = header.text(948, 3);
  return to_scanner * reordered(to_scanner, letters[0] == 0 ? "LPS" : letters, dimensions) * to_voxels;
}

}  // namespace

Polylines read_trk(const std::filesystem::path& path, Real unit) {
  const std::string bytes = read_text(path);
  const TrkHeader header(path, bytes);
  const Eigen::Matrix4d transform = trk_transform(header);
  const Real scalars = header.number(36, ScalarType::int16), properties = header.number(238, ScalarType::int16);
  const Real announced = header.number(988, ScalarType::int32);  // 0: not known
  ValueReader reader(path, std::string_view(bytes).substr(trk_header_size));
  reader.encoding = header.encoding;
  if (scalars < 0 || properties < 0 || announced < 0) reader.fail("its header has a negative count");
  std::vector<Points> lines;
  std::size_t read = 0;
  for (; announced > 0 ? static_cast<Real>(read) < announced : !reader.at_end(); ++read) {
    const Real size = reader.number(ScalarType::int32);
    if (size < 0 || size * (3 + scalars) * 4 > static_cast<Real>(bytes.size()))
      reader.fail(fmt::format("announces a track of {} points, which the file cannot hold", size));
    Points line(3, static_cast<Index>(size));
    for (Index i = 0; i < static_cast<Index>(line.cols()); ++i) {
      for (Index k = 0; k < 3; ++k) line(k, i) = reader.number(ScalarType::float32);
      if (!line.col(i).allFinite()) reader.fail("a point is not finite");
      for (Real k = 0; k < scalars; ++k) reader.number(ScalarType::float32);
      line.col(i) = unit * (transform.topLeftCorner<3, 3>() * line.col(i) + transform.topRightCorner<3, 1>());
    }
    for (Real k = 0; k < properties; ++k) reader.number(ScalarType::float32);
    if (line.cols() >= 2) lines.push_back(std::move(line));
  }
  return join(lines);
}

}  // namespace gracilis
