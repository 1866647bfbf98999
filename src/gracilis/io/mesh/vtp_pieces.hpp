#pragma once

#include <gracilis/geometry/polylines.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>
#include <gracilis/io/mesh/mesh_reader_vtp.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gracilis {

/// One surface, or one set of lines, of several in a file.
struct VtpPiece {
  std::string name;
  Points points;
  Eigen::Matrix3Xi faces = Eigen::Matrix3Xi(3, 0);
  std::vector<Index> line_offsets = {0};  ///< as those of Polylines; {0}: no lines
  std::vector<VertexArray> arrays = {};   ///< of the same names in all pieces of a file
};

/// Numbers of a file as a whole.
using VtpField = std::pair<std::string, Eigen::VectorXd>;

/// Writes several pieces as one .vtp, whole or not at all: appended, by zlib, double points, 32-bit indices. Arrays
/// that are the same in several pieces, as the triangles of muscles of one make, stand there once. ParaView shows the
/// pieces as one data set whose cells tell by `part` which piece they are of. Throws InputError.
void write_vtp_pieces(const std::filesystem::path& path, const std::vector<VtpPiece>& pieces,
                      const std::vector<VtpField>& fields = {});

/// The surface of one piece with the bits that were written. Throws InputError where the file or the piece is missing
/// or damaged.
TriangleMesh read_vtp_piece(const VtpFile& file, const std::string& piece);
/// Its lines; none where the file has no such piece. Throws InputError, too, where they have fewer than two points, one
/// that is not finite, or do not go through the points in turn.
Polylines read_vtp_lines(const std::filesystem::path& path, const std::string& piece);

}  // namespace gracilis
