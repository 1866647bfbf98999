#include <gracilis/geometry/signed_distance.hpp>

#include <gracilis/geometry/angle_between.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_inspection.hpp>
#include <gracilis/geometry/self_crossings.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

/// Which of a face's edges k → k+1 is (a, b), in either direction.
static int edge_in_face(const Eigen::Matrix3Xi& faces, Index face, Index a, Index b) {
  for (int k = 0; k < 3; ++k) {
    const Index from = faces(k, face), to = faces((k + 1) % 3, face);
    if ((from == a && to == b) || (from == b && to == a)) return k;
  }
  return 0;
}

/// Triangles whose normals differ by more than this lie over each other, or nearly so; the cosine.
static constexpr Real folded = -0.5;
/// Rings of triangles around a fold, or around where a surface crosses itself, that are part of it.
static constexpr int doubtful_rings = 2;

/// Faces at folds and crossings: where a triangle lies over others the wrong way up, points beyond it seem inside at
/// any distance.
static std::vector<char> faces_at_folds(const TriangleTree& triangles, const TriangleMesh& mesh,
                                        const std::vector<MeshEdge>& edges, const Points& face_normals) {
  std::vector<char> reached(static_cast<std::size_t>(mesh.vertex_count()), 0);
  const auto reach = [&](Index v) { reached[static_cast<std::size_t>(v)] = 1; };
  for (const MeshEdge& edge : edges)
    if (face_normals.col(edge.left).dot(face_normals.col(edge.right)) < folded) reach(edge.a), reach(edge.b);
  std::vector<char> found = crossing_faces(triangles, mesh, edges);
  for (Index face = 0; face < mesh.face_count(); ++face)
    if (found[static_cast<std::size_t>(face)])
      for (const Index v : mesh.faces.col(face)) reach(v);
  if (std::none_of(reached.begin(), reached.end(), [](char each) { return each != 0; })) return found;
  const auto is_reached = [&](Index v) { return reached[static_cast<std::size_t>(v)] != 0; };
  for (int ring = 0; ring < doubtful_rings; ++ring) {
    for (Index face = 0; face < mesh.face_count(); ++face)
      found[static_cast<std::size_t>(face)] =
          std::any_of(mesh.faces.col(face).begin(), mesh.faces.col(face).end(), is_reached);
    for (Index face = 0; face < mesh.face_count(); ++face)
      if (found[static_cast<std::size_t>(face)])
        for (const Index v : mesh.faces.col(face)) reach(v);
  }
  return found;
}

/// Whether a face lies between the inside and the outside, its normal towards the outside.
static bool tells_the_side(const TriangleMesh& mesh, const WindingNumber& winding, Index face) {
  constexpr Real beside = 1e-3;  // of its size
  const Vec3 area = area_vector(mesh.vertices, mesh.faces.col(face));
  const Vec3 center = mesh.vertices(Eigen::all, mesh.faces.col(face)).rowwise().mean();
  const Vec3 step = beside * std::sqrt(area.norm()) * area.stableNormalized();
  return winding.query(center + step) < 0.5 && winding.query(center - step) > 0.5;
}

/// Where a surface passes through itself whole parts of it may lie inside of others, or inside out.
void SignedDistance::find_doubtful(const TriangleMesh& mesh, const std::vector<MeshEdge>& edges) {
  doubtful_ = faces_at_folds(nearest_triangle_.triangles(), mesh, edges, face_normals_);
  if (std::none_of(doubtful_.begin(), doubtful_.end(), [](char each) { return each != 0; })) return;
  winding_.emplace(mesh);
  std::vector<Index> others;
  for (Index face = 0; face < mesh.face_count(); ++face)
    if (!doubtful_[static_cast<std::size_t>(face)]) others.push_back(face);
  // What hangs together between them is all alike: one face tells for the others.
  const std::vector<Index> component = component_of_vertices({mesh.vertices, mesh.faces(Eigen::all, others)});
  const auto component_of = [&](Index face) {
    return static_cast<std::size_t>(component[static_cast<std::size_t>(mesh.faces(0, face))]);
  };
  const auto size = [&](Index face) { return area_vector(mesh.vertices, mesh.faces.col(face)).norm(); };
  std::vector<Index> largest(static_cast<std::size_t>(component_count(component)), -1);
  for (const Index face : others)
    if (Index& found = largest[component_of(face)]; found < 0 || size(face) > size(found)) found = face;
  std::vector<char> tells;
  for (const Index face : largest) tells.push_back(tells_the_side(mesh, *winding_, face));
  for (const Index face : others)
    if (!tells[component_of(face)]) doubtful_[static_cast<std::size_t>(face)] = 1;
}

SignedDistance::SignedDistance(const TriangleMesh& mesh)
    : faces_(mesh.faces), closed_(is_closed(mesh.faces)), nearest_triangle_(mesh) {
  if (!closed_) {
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
  const std::vector<MeshEdge> edges = build_topology(mesh.faces, mesh.vertex_count()).edges;
  for (const MeshEdge& edge : edges) {
    const Vec3 normal = face_normals_.col(edge.left) + face_normals_.col(edge.right);
    edge_normals_.col(3 * edge.left + edge_in_face(faces_, edge.left, edge.a, edge.b)) = normal;
    edge_normals_.col(3 * edge.right + edge_in_face(faces_, edge.right, edge.a, edge.b)) = normal;
  }
  find_doubtful(mesh, edges);
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
  const bool normals_tell = closed_ && !doubtful_[static_cast<std::size_t>(nearest.face)];
  const bool inside = normals_tell ? (p - nearest.point).dot(pseudonormal(nearest)) < 0 : winding_->query(p) > 0.5;
  return {inside ? -nearest.distance : nearest.distance, nearest};
}

SignedDistance::Answer SignedDistance::query(const Vec3& p, Real reach) const {
  return with_sign(nearest_triangle_.query(p, reach), p);
}

SignedDistance::Answer SignedDistance::query_from(Index guess, const Vec3& p) const {
  return with_sign(nearest_triangle_.query_from(guess, p), p);
}

Real share_within(const TriangleMesh& mesh, const SignedDistance& other, Real reach, Index samples) {
  const Index step = std::max<Index>(1, mesh.vertex_count() / samples);
  Index within = 0, count = 0;
  for (Index v = 0; v < mesh.vertex_count(); v += step, ++count)
    within += other.query(mesh.vertices.col(v)).distance < reach;
  return count == 0 ? 0 : static_cast<Real>(within) / static_cast<Real>(count);
}

}  // namespace gracilis
