#include <gracilis/geometry/signed_distance.hpp>

#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/topology.hpp>

#include <cmath>

namespace gracilis {

static Real corner_angle(const Vec3& at, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - at, v = c - at;
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

/// Which of a face's edges k → k+1 is (a, b), in either direction.
static int edge_in_face(const Eigen::Matrix3Xi& faces, Index face, Index a, Index b) {
  for (int k = 0; k < 3; ++k) {
    const Index from = faces(k, face), to = faces((k + 1) % 3, face);
    if ((from == a && to == b) || (from == b && to == a)) return k;
  }
  return 0;
}

SignedDistance::SignedDistance(const TriangleMesh& mesh) : faces_(mesh.faces), nearest_triangle_(mesh) {
  if (!is_closed(mesh.faces)) {
    winding_.emplace(mesh);
    return;
  }
  face_normals_.resize(3, mesh.face_count());
  vertex_normals_.setZero(3, mesh.vertex_count());
  edge_normals_.setZero(3, 3 * mesh.face_count());
  for (Index face = 0; face < mesh.face_count(); ++face) {
    face_normals_.col(face) = area_vector(mesh.vertices, mesh.faces.col(face)).normalized();
    for (int k = 0; k < 3; ++k) {
      const Vec3 at = mesh.vertices.col(faces_(k, face)), b = mesh.vertices.col(faces_((k + 1) % 3, face)),
                 c = mesh.vertices.col(faces_((k + 2) % 3, face));
      vertex_normals_.col(faces_(k, face)) += corner_angle(at, b, c) * face_normals_.col(face);
    }
  }
  for (const MeshEdge& edge : build_topology(mesh.faces, mesh.vertex_count()).edges) {
    const Vec3 normal = face_normals_.col(edge.left) + face_normals_.col(edge.right);
    edge_normals_.col(3 * edge.left + edge_in_face(faces_, edge.left, edge.a, edge.b)) = normal;
    edge_normals_.col(3 * edge.right + edge_in_face(faces_, edge.right, edge.a, edge.b)) = normal;
  }
}

Vec3 SignedDistance::pseudonormal(const NearestPoint& nearest) const {
  const Vec3& w = nearest.barycentric;
  for (int k = 0; k < 3; ++k)
    if (w[k] == 1) return vertex_normals_.col(faces_(k, nearest.face));
  for (int k = 0; k < 3; ++k)
    if (w[(k + 2) % 3] == 0) return edge_normals_.col(3 * nearest.face + k);
  return face_normals_.col(nearest.face);
}

SignedDistance::Answer SignedDistance::with_sign(const NearestPoint& nearest, const Vec3& p) const {
  if (nearest.face < 0) return {std::numeric_limits<Real>::infinity(), nearest};
  const bool inside = winding_ ? winding_->query(p) > 0.5 : (p - nearest.point).dot(pseudonormal(nearest)) < 0;
  return {inside ? -nearest.distance : nearest.distance, nearest};
}

SignedDistance::Answer SignedDistance::query(const Vec3& p, Real reach) const {
  return with_sign(nearest_triangle_.query(p, reach), p);
}

SignedDistance::Answer SignedDistance::query_from(Index guess, const Vec3& p) const {
  return with_sign(nearest_triangle_.query_from(guess, p), p);
}

}  // namespace gracilis
