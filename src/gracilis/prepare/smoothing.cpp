#include <gracilis/prepare/smoothing.hpp>

#include <gracilis/geometry/angle_between.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/smoothing.hpp>
#include <gracilis/geometry/topology.hpp>

#include <algorithm>

namespace gracilis {

static Real turn_at(const TriangleMesh& mesh, const MeshEdge& edge) {
  const Vec3 left = area_vector(mesh.vertices, mesh.faces.col(edge.left));
  const Vec3 right = area_vector(mesh.vertices, mesh.faces.col(edge.right));
  return angle_between(left, right);
}

void smooth_surface(TriangleMesh& mesh, int rounds) {
  smooth_points(mesh.vertices, build_topology(mesh.faces, mesh.vertex_count()).stars, rounds);
}

Index round_off(TriangleMesh& mesh, Real sharp, int rounds, Real farthest) {
  const MeshTopology topology = build_topology(mesh.faces, mesh.vertex_count());
  const Points start = mesh.vertices;
  for (int round = 0;; ++round) {
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(mesh.vertex_count());
    Index count = 0;
    for (const MeshEdge& edge : topology.edges) {
      if (edge.left < 0 || edge.right < 0 || turn_at(mesh, edge) <= sharp) continue;
      ++count;
      for (Index v : {edge.a, edge.b, edge.left_apex, edge.right_apex}) weights[v] = 1;
    }
    if (count == 0 || round >= rounds) return count;
    for (Real share : {0.6, 0.3}) {
      const Eigen::VectorXd inner = weights;
      for (const MeshEdge& edge : topology.edges) {
        if (inner[edge.a] > 0) weights[edge.b] = std::max(weights[edge.b], share);
        if (inner[edge.b] > 0) weights[edge.a] = std::max(weights[edge.a], share);
      }
    }
    move_to_means(mesh.vertices, topology.stars, weights, smoothing_forth);
    // What is thin would shrink to a thread without the way back.
    move_to_means(mesh.vertices, topology.stars, weights, 0.8 * smoothing_back);
    keep_within(farthest, start, mesh.vertices);
  }
}

Index sharp_edge_count(const TriangleMesh& mesh, Real sharp) {
  Index count = 0;
  for (const MeshEdge& edge : build_topology(mesh.faces, mesh.vertex_count()).edges)
    if (edge.left >= 0 && edge.right >= 0 && turn_at(mesh, edge) > sharp) ++count;
  return count;
}

}  // namespace gracilis
