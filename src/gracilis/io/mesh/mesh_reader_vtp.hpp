#pragma once

#include <gracilis/io/mesh/polygon_mesh.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace gracilis {

/// A .vtp in memory, of which several pieces are asked one after the other or by several threads: read from the disk
/// once. The functions below do the same with a file each time, and say what is read and which errors there are.
class VtpFile {
 public:
  explicit VtpFile(const std::filesystem::path& path);
  ~VtpFile();

  const std::filesystem::path& path() const;
  std::size_t size() const;  ///< bytes, as on the disk
  bool has(const std::string& piece) const;
  PolygonMesh read() const;
  PolygonMesh read(const std::string& piece) const;
  Points vectors(const std::string& name, const std::string& piece = "") const;
  Eigen::VectorXd scalars(const std::string& name, const std::string& piece = "") const;
  std::vector<double> field(const std::string& name) const;

  struct Text;

 private:
  std::unique_ptr<const Text> text_;
};

/// Reads the polygons and strips of a .vtp: ascii, binary and appended arrays of any type, compressed or not, in any
/// number of pieces. VTK's own reader crashes on damaged block sizes, hence this one.
PolygonMesh read_vtp(const std::filesystem::path& path);

/// The point data `name` of a .vtp of one piece, 3 × n; 3 × 0 when the file has no such array. Throws InputError as
/// above and when the numbers are not threes.
Points read_vtp_vectors(const std::filesystem::path& path, const std::string& name, const std::string& piece = "");

/// The same of one piece of several, which its attribute Name tells (write_vtp_pieces). Throws InputError where there
/// is none of that name.
PolygonMesh read_vtp(const std::filesystem::path& path, const std::string& piece);
bool has_vtp_piece(const std::filesystem::path& path, const std::string& piece);

/// Numbers of the file as a whole (its FieldData); none where it has no such.
std::vector<double> read_vtp_field(const std::filesystem::path& path, const std::string& name);

/// The same of one number for each point, of the first piece where none is named; none when there is no such array.
Eigen::VectorXd read_vtp_scalars(const std::filesystem::path& path, const std::string& name,
                                 const std::string& piece = "");

}  // namespace gracilis
