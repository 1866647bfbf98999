#pragma once

#include <gracilis/io/mesh/polygon_mesh.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace gracilis {

/// A .vtp in memory, of which several pieces are asked one after the other or by several threads: read from the disk
/// once. Everything throws InputError where the file is damaged or has no piece of that name.
class VtpFile {
 public:
  /// Reads the file.
  explicit VtpFile(const std::filesystem::path& path);
  ~VtpFile();

  const std::filesystem::path& path() const;  ///< of the file
  std::size_t size() const;                   ///< bytes, as on the disk
  /// Whether there is a piece whose attribute Name says so (write_vtp_pieces).
  bool has(const std::string& piece) const;
  /// The polygons and strips of all pieces, or of one: ascii, binary and appended arrays of any type, compressed or
  /// not.
  PolygonMesh read() const;
  /// Of the piece of this name.
  PolygonMesh read(const std::string& piece) const;
  /// The point data `name`, 3 × n, of the first piece where none is named; 3 × 0 when there is no such array. Throws
  /// InputError where the numbers are not threes, too.
  Points vectors(const std::string& name, const std::string& piece = "") const;
  /// The same of one number for each point; none when there is no such array.
  Eigen::VectorXd scalars(const std::string& name, const std::string& piece = "") const;
  /// Numbers of the file as a whole (its FieldData); none where it has no such.
  std::vector<double> field(const std::string& name) const;

  struct Text;

 private:
  std::unique_ptr<const Text> text_;
};

/// All of a .vtp, as above. VTK's own reader crashes on damaged block sizes, hence this one.
PolygonMesh read_vtp(const std::filesystem::path& path);

}  // namespace gracilis
