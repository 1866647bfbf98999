#include <gracilis/anatomy/resolution/finer_muscle.hpp>

#include <gracilis/anatomy/resolution/divided_muscle.hpp>
#include <gracilis/geometry/topology.hpp>

namespace gracilis {

namespace {

/// The surface, and which new vertex is in the middle of which edge.
struct Divided {
  TriangleMesh surface;
  std::vector<MeshEdge> edges;  ///< edge i has its middle at vertex `first_middle` + i
  Index first_middle = 0;
};

Divided divide(const TriangleMesh& mesh) {
  Divided divided;
  divided.edges = build_topology(mesh.faces, mesh.vertex_count()).edges;
  divided.first_middle = mesh.vertex_count();
  const auto edge_count = static_cast<Index>(divided.edges.size());
  Points& vertices = divided.surface.vertices;
  vertices.resize(3, mesh.vertex_count() + edge_count);
  vertices.leftCols(mesh.vertex_count()) = mesh.vertices;
  Eigen::Matrix3Xi middles(3, mesh.face_count());  // opposite to each corner
  for (Index e = 0; e < edge_count; ++e) {
    const MeshEdge& edge = divided.edges[static_cast<std::size_t>(e)];
    vertices.col(divided.first_middle + e) = (mesh.vertices.col(edge.a) + mesh.vertices.col(edge.b)) / 2;
    for (const Index face : {edge.left, edge.right}) {
      if (face < 0) continue;
      for (int corner = 0; corner < 3; ++corner)
        if (mesh.faces(corner, face) != edge.a && mesh.faces(corner, face) != edge.b)
          middles(corner, face) = divided.first_middle + e;
    }
  }
  divided.surface.faces.resize(3, 4 * mesh.face_count());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Eigen::Vector3i corner = mesh.faces.col(f), middle = middles.col(f);
    for (int k = 0; k < 3; ++k)
      divided.surface.faces.col(4 * f + k) = Eigen::Vector3i(corner[k], middle[(k + 2) % 3], middle[(k + 1) % 3]);
    divided.surface.faces.col(4 * f + 3) = middle;
  }
  return divided;
}

}  // namespace

Muscle finer_muscle(const Muscle& muscle) {
  Muscle finer = muscle;
  const Divided divided = divide(muscle.surface);
  finer.surface = divided.surface;
  VerticesBetween middles{divided.first_middle, {}};
  for (const MeshEdge& edge : divided.edges) middles.ends.push_back({edge.a, edge.b});
  for (Attachment& attachment : finer.attachments) add_vertices_between(middles, attachment.vertices);
  return finer;
}

}  // namespace gracilis
