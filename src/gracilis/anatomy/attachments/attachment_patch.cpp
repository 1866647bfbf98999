#include <gracilis/anatomy/attachments/attachment_patch.hpp>

#include <gracilis/geometry/mesh_inspection.hpp>

#include <algorithm>

namespace gracilis {

std::vector<std::size_t> bones_under(const TriangleMesh& patch, std::span<const NearestTriangle* const> bones) {
  const std::vector<Index> pieces = component_of_vertices(patch);
  const Index count = component_count(pieces);
  Eigen::MatrixXd distances = Eigen::MatrixXd::Zero(std::max<Index>(count, 1), static_cast<Index>(bones.size()));
  for (Index v = 0; v < patch.vertex_count(); ++v) {
    const Index piece = pieces[static_cast<std::size_t>(v)];
    if (piece < 0) continue;
    for (std::size_t b = 0; b < bones.size(); ++b)
      distances(piece, static_cast<Index>(b)) += bones[b]->query(patch.vertices.col(v)).distance;
  }
  std::vector<std::size_t> under;
  for (Index f = 0; f < patch.face_count(); ++f) {
    Eigen::Index nearest = 0;
    distances.row(pieces[static_cast<std::size_t>(patch.faces(0, f))]).minCoeff(&nearest);
    under.push_back(static_cast<std::size_t>(nearest));
  }
  return under;
}

TriangleMesh kept_faces(const TriangleMesh& mesh, const std::vector<char>& keep) {
  std::vector<Index> kept;
  for (Index f = 0; f < mesh.face_count(); ++f)
    if (keep[static_cast<std::size_t>(f)] != 0) kept.push_back(f);
  return {mesh.vertices, mesh.faces(Eigen::all, kept)};
}

}  // namespace gracilis
