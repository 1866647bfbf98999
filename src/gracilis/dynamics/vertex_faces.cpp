#include <gracilis/dynamics/vertex_faces.hpp>

#include <gracilis/core/group_by_key.hpp>

#include <utility>

namespace gracilis {

VertexFaces build_vertex_faces(const Eigen::Matrix3Xi& faces, Index particle_count) {
  GroupedByKey corners = group_by_key({faces.data(), static_cast<std::size_t>(faces.size())}, particle_count);
  VertexFaces vertex_faces;
  vertex_faces.offsets = std::move(corners.begins);
  vertex_faces.faces.reserve(corners.items.size());
  vertex_faces.ends.resize(2, faces.size());
  for (const Index corner : corners.items) {
    const Index face = corner / 3, row = corner % 3;
    vertex_faces.ends.col(static_cast<Index>(vertex_faces.faces.size())) << faces((row + 1) % 3, face),
        faces((row + 2) % 3, face);
    vertex_faces.faces.push_back(face);
  }
  return vertex_faces;
}

}  // namespace gracilis
