#include <gracilis/geometry/self_crossings.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/point_triangle.hpp>

#include <algorithm>
#include <atomic>

namespace gracilis {

namespace {

constexpr Index edges_per_task = 1024;

/// One edge on its way through all triangles.
struct EdgeAmongFaces {
  const TriangleMesh& mesh;
  const MeshEdge& edge;
  std::vector<std::atomic<char>>& crossing;
};

/// Whether the edge comes to the triangle where it goes through its plane. An edge that lies in that plane, but
/// elsewhere, goes through it wherever rounding says.
bool comes_to(const TriangleMesh& mesh, const MeshEdge& edge, Index face) {
  constexpr Real near = 1e-3;  // of the edge
  const Vec3 from = mesh.vertices.col(edge.a), along = mesh.vertices.col(edge.b) - from;
  const Eigen::Matrix3d triangle = mesh.vertices(Eigen::all, mesh.faces.col(face));
  const Vec3 normal = (triangle.col(1) - triangle.col(0)).cross(triangle.col(2) - triangle.col(0));
  const Real slope = normal.dot(along);
  if (slope == 0) return false;
  const Real share = std::clamp(normal.dot(triangle.col(0) - from) / slope, 0.0, 1.0);
  const Vec3 through = from + share * along;
  const Vec3 nearest = triangle * nearest_barycentric(through, triangle.col(0), triangle.col(1), triangle.col(2));
  return (through - nearest).norm() <= near * along.norm();
}

/// Marks a triangle that the edge runs through.
void note_crossing(Index face, void* of_edge) {
  const auto& query = *static_cast<const EdgeAmongFaces*>(of_edge);
  for (const Index corner : query.mesh.faces.col(face))
    if (corner == query.edge.a || corner == query.edge.b) return;
  if (!comes_to(query.mesh, query.edge, face)) return;
  const auto mark = [&](Index each) {
    if (each >= 0) query.crossing[static_cast<std::size_t>(each)].store(1, std::memory_order_relaxed);
  };
  mark(face), mark(query.edge.left), mark(query.edge.right);
}

}  // namespace

std::vector<char> crossing_faces(const TriangleTree& triangles, const TriangleMesh& mesh,
                                 const std::vector<MeshEdge>& edges) {
  std::vector<std::atomic<char>> crossing(static_cast<std::size_t>(mesh.face_count()));
  parallel_for(static_cast<Index>(edges.size()), edges_per_task, [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      const MeshEdge& edge = edges[static_cast<std::size_t>(e)];
      EdgeAmongFaces query{mesh, edge, crossing};
      triangles.all(mesh.vertices.col(edge.a), mesh.vertices.col(edge.b), note_crossing, &query);
    }
  });
  return {crossing.begin(), crossing.end()};
}

}  // namespace gracilis
