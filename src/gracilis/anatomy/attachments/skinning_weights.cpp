#include <gracilis/anatomy/attachments/skinning_weights.hpp>

#include <gracilis/anatomy/attachments/joined_pieces.hpp>
#include <gracilis/geometry/harmonic_field.hpp>
#include <gracilis/geometry/shortest_paths.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

/// Solves that grade the tendons; the largest gradient hardly changes after these.
static constexpr int grading_rounds = 8;

/// Per edge: the sum over all fields of the squared gradient, mean of the edge's triangles, 1/m².
static std::vector<Real> squared_gradients(const TriangleMesh& surface, const std::vector<MeshEdge>& edges,
                                           const Eigen::MatrixXd& fields) {
  Eigen::VectorXd faces = Eigen::VectorXd::Zero(surface.face_count());
  for (Index k = 0; k < fields.cols(); ++k)
    faces += face_gradients(surface.vertices, surface.faces, fields.col(k)).colwise().squaredNorm().transpose();
  std::vector<Real> squares;
  for (const MeshEdge& edge : edges) {
    Real sum = 0;
    int sides = 0;
    for (Index face : {edge.left, edge.right})
      if (face >= 0) sum += faces[face], ++sides;
    squares.push_back(sides > 0 ? sum / sides : 0);
  }
  return squares;
}

/// One round towards w = max(|∇h|²/mean, 1)^q, q falling from 1 at attachments to 0 at the tendon's end. Where q = 1
/// that is the weight whose harmonic field is 4-harmonic; a geometric mean with the last weight makes it converge.
static void grade(const std::vector<Real>& squares, const std::vector<Real>& tendon, std::vector<Real>& conductance) {
  Real mean = 0;
  for (Real square : squares) mean += square / static_cast<Real>(squares.size());
  if (!(mean > 0)) return;
  for (std::size_t e = 0; e < squares.size(); ++e)
    conductance[e] = std::sqrt(conductance[e] * std::pow(std::max(squares[e] / mean, Real{1}), tendon[e]));
}

Eigen::MatrixXf skinning_weights(const TriangleMesh& surface, const MeshTopology& of_surface,
                                 const std::vector<Index>& fixed_body, const std::vector<Index>& bodies,
                                 Real tendon_length) {
  const MeshTopology topology = joined_pieces(surface, of_surface, fixed_body);
  std::vector<Index> fixed;
  for (Index v = 0; v < surface.vertex_count(); ++v)
    if (fixed_body[static_cast<std::size_t>(v)] >= 0) fixed.push_back(v);
  Eigen::MatrixXd values(static_cast<Index>(fixed.size()), static_cast<Index>(bodies.size()));
  for (Index i = 0; i < values.rows(); ++i)
    for (Index k = 0; k < values.cols(); ++k)
      values(i, k) = fixed_body[static_cast<std::size_t>(fixed[static_cast<std::size_t>(i)])] ==
                     bodies[static_cast<std::size_t>(k)];
  HarmonicSolver solver(surface.vertices, topology, fixed);
  Eigen::MatrixXd fields = solver.solve(values);
  if (!(tendon_length > 0) || bodies.size() < 2) return fields.transpose().cast<float>();

  const Eigen::VectorXd distances = edge_distances(length_graph(surface.vertices, topology), fixed);
  std::vector<Real> tendon, conductance(topology.edges.size(), 1);
  for (const MeshEdge& edge : topology.edges)
    tendon.push_back(std::max(1 - (distances[edge.a] + distances[edge.b]) / 2 / tendon_length, Real{0}));
  for (int round = 0; round < grading_rounds; ++round) {
    grade(squared_gradients(surface, topology.edges, fields), tendon, conductance);
    fields = solver.solve(values, conductance);
  }
  return fields.transpose().cast<float>();
}

}  // namespace gracilis
