#include <gracilis/geometry/self_crossings.hpp>

#include <gracilis/core/parallel.hpp>

#include <atomic>

namespace gracilis {

namespace {

constexpr Index edges_per_task = 1024;

/// One edge on its way through all triangles.
struct EdgeAmongFaces {
  const Eigen::Matrix3Xi& faces;
  const MeshEdge& edge;
  std::vector<std::atomic<char>>& crossing;
};

/// Marks a triangle that the edge runs through.
void note_crossing(Index face, void* of_edge) {
  const auto& query = *static_cast<const EdgeAmongFaces*>(of_edge);
  for (const Index corner : query.faces.col(face))
    if (corner == query.edge.a || corner == query.edge.b) return;
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
      EdgeAmongFaces query{mesh.faces, edge, crossing};
      triangles.all(mesh.vertices.col(edge.a), mesh.vertices.col(edge.b), note_crossing, &query);
    }
  });
  return {crossing.begin(), crossing.end()};
}

}  // namespace gracilis
