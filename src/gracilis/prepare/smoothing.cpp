#include <gracilis/prepare/smoothing.hpp>

#include <gracilis/geometry/angle_between.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/topology.hpp>

#include <algorithm>

namespace gracilis {

// Taubin 1995, with a pass-band of 0.11.
static constexpr Real forth = 0.5, back = -0.53;

static Real turn_at(const TriangleMesh& mesh, const MeshEdge& edge) {
  const Vec3 left = area_vector(mesh.vertices, mesh.faces.col(edge.left));
  const Vec3 right = area_vector(mesh.vertices, mesh.faces.col(edge.right));
  return angle_between(left, right);
}

void move_to_means(Points& vertices, const VertexStars& stars, const Eigen::VectorXd& weights, Real factor) {
  const Points before = vertices;
  for (Index v = 0; v < vertices.cols(); ++v) {
    const Index begin = stars.offsets[static_cast<std::size_t>(v)],
                end = stars.offsets[static_cast<std::size_t>(v) + 1];
    if (weights[v] == 0 || begin == end) continue;
    Vec3 mean = Vec3::Zero();
    for (Index i = begin; i < end; ++i) mean += before.col(stars.neighbors[static_cast<std::size_t>(i)]);
    vertices.col(v) += factor * weights[v] * (mean / (end - begin) - before.col(v));
  }
}

void smooth_surface(TriangleMesh& mesh, int rounds) {
  const MeshTopology topology = build_topology(mesh.faces, mesh.vertex_count());
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(mesh.vertex_count());
  for (int round = 0; round < rounds; ++round) {
    move_to_means(mesh.vertices, topology.stars, all, forth);
    move_to_means(mesh.vertices, topology.stars, all, back);
  }
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
    move_to_means(mesh.vertices, topology.stars, weights, forth);
    // What is thin would shrink to a thread without the way back.
    move_to_means(mesh.vertices, topology.stars, weights, 0.8 * back);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Vec3 moved = mesh.vertices.col(v) - start.col(v);
      if (moved.norm() > farthest) mesh.vertices.col(v) = start.col(v) + moved.normalized() * farthest;
    }
  }
}

Index sharp_edge_count(const TriangleMesh& mesh, Real sharp) {
  Index count = 0;
  for (const MeshEdge& edge : build_topology(mesh.faces, mesh.vertex_count()).edges)
    if (edge.left >= 0 && edge.right >= 0 && turn_at(mesh, edge) > sharp) ++count;
  return count;
}

}  // namespace gracilis
