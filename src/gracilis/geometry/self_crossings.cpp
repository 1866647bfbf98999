#include <gracilis/geometry/self_crossings.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/embree_scene.hpp>

#include <atomic>

namespace gracilis {

namespace {

constexpr Index edges_per_task = 1024;

/// One edge on its way through all triangles. Embree hands the context on to `note_hit`.
struct EdgeAmongFaces {
  RTCIntersectContext context;  ///< first, so that one is the other
  const Eigen::Matrix3Xi* faces;
  const MeshEdge* edge;
  std::vector<std::atomic<char>>* crossing;
};

/// Marks a triangle that the edge runs through, and lets the edge run on.
void note_hit(const RTCFilterFunctionNArguments* arguments) {
  arguments->valid[0] = 0;
  const auto& query = *reinterpret_cast<const EdgeAmongFaces*>(arguments->context);
  const auto face = static_cast<Index>(RTCHitN_primID(arguments->hit, arguments->N, 0));
  for (const Index corner : query.faces->col(face))
    if (corner == query.edge->a || corner == query.edge->b) return;
  const auto mark = [&](Index each) {
    if (each >= 0) (*query.crossing)[static_cast<std::size_t>(each)].store(1, std::memory_order_relaxed);
  };
  mark(face), mark(query.edge->left), mark(query.edge->right);
}

}  // namespace

std::vector<char> crossing_faces(const TriangleMesh& mesh, const std::vector<MeshEdge>& edges) {
  const EmbreeScene scene(mesh, nullptr, RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  std::vector<std::atomic<char>> crossing(static_cast<std::size_t>(mesh.face_count()));
  parallel_for(static_cast<Index>(edges.size()), edges_per_task, [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      const MeshEdge& edge = edges[static_cast<std::size_t>(e)];
      EdgeAmongFaces query{{}, &mesh.faces, &edge, &crossing};
      rtcInitIntersectContext(&query.context);
      query.context.filter = note_hit;
      RTCRay ray = ray_along(mesh.vertices.col(edge.a) - scene.place(), mesh.vertices.col(edge.b) - scene.place());
      rtcOccluded1(scene.get(), &query.context, &ray);
    }
  });
  return {crossing.begin(), crossing.end()};
}

}  // namespace gracilis
