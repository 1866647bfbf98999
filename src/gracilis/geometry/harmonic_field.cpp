#include <gracilis/geometry/harmonic_field.hpp>

#include <gracilis/geometry/measures.hpp>

#include <algorithm>
#include <utility>

namespace gracilis {

static constexpr Real shortest_edge = 1e-9;

/// Numbers the free vertices that a fixed vertex can reach; all others get -1.
static std::vector<Index> number_unknowns(const MeshTopology& topology, const std::vector<Index>& fixed,
                                          Index& unknown_count) {
  const VertexStars& stars = topology.stars;
  std::vector<Index> numbers(stars.offsets.size() - 1, -1), front = fixed;
  std::vector<char> seen(numbers.size(), 0);
  for (Index v : fixed) seen[static_cast<std::size_t>(v)] = 1;
  unknown_count = 0;
  while (!front.empty()) {
    const auto v = static_cast<std::size_t>(front.back());
    front.pop_back();
    for (Index i = stars.offsets[v]; i < stars.offsets[v + 1]; ++i) {
      const Index neighbor = stars.neighbors[static_cast<std::size_t>(i)];
      if (seen[static_cast<std::size_t>(neighbor)]) continue;
      seen[static_cast<std::size_t>(neighbor)] = 1;
      numbers[static_cast<std::size_t>(neighbor)] = unknown_count++;
      front.push_back(neighbor);
    }
  }
  return numbers;
}

HarmonicSolver::HarmonicSolver(const Points& vertices, const MeshTopology& topology, std::vector<Index> fixed)
    : vertices_(vertices), topology_(topology), fixed_(std::move(fixed)) {
  numbers_ = number_unknowns(topology, fixed_, unknown_count_);
}

Eigen::MatrixXd HarmonicSolver::solve(const Eigen::MatrixXd& fixed_values, const std::vector<Real>& conductance) {
  Eigen::MatrixXd fields = Eigen::MatrixXd::Zero(vertices_.cols(), fixed_values.cols());
  for (std::size_t i = 0; i < fixed_.size(); ++i) fields.row(fixed_[i]) = fixed_values.row(static_cast<Index>(i));
  if (unknown_count_ == 0) return fields;

  std::vector<Eigen::Triplet<Real>> entries;
  entries.reserve(3 * topology_.edges.size());
  Eigen::MatrixXd right_side = Eigen::MatrixXd::Zero(unknown_count_, fixed_values.cols());
  for (std::size_t e = 0; e < topology_.edges.size(); ++e) {
    const MeshEdge& edge = topology_.edges[e];
    const Real length = std::max((vertices_.col(edge.a) - vertices_.col(edge.b)).norm(), shortest_edge);
    const Real weight = (conductance.empty() ? 1 : conductance[e]) / length;
    for (const auto& [vertex, other] : {std::pair{edge.a, edge.b}, std::pair{edge.b, edge.a}}) {
      const Index row = numbers_[static_cast<std::size_t>(vertex)], column = numbers_[static_cast<std::size_t>(other)];
      if (row < 0) continue;
      entries.emplace_back(row, row, weight);
      if (column >= 0) {
        if (column < row) entries.emplace_back(row, column, -weight);  // all that the factorization reads
      } else {
        right_side.row(row) += weight * fields.row(other);
      }
    }
  }
  Eigen::SparseMatrix<Real> laplacian(unknown_count_, unknown_count_);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  entries = std::vector<Eigen::Triplet<Real>>();  // gives the memory back
  if (!is_analyzed_) factorization_.analyzePattern(laplacian);
  is_analyzed_ = true;
  factorization_.factorize(laplacian);
  const Eigen::MatrixXd solution = factorization_.solve(right_side);
  for (Index v = 0; v < vertices_.cols(); ++v)
    if (numbers_[static_cast<std::size_t>(v)] >= 0) fields.row(v) = solution.row(numbers_[static_cast<std::size_t>(v)]);
  return fields;
}

Eigen::MatrixXd harmonic_fields(const Points& vertices, const MeshTopology& topology, const std::vector<Index>& fixed,
                                const Eigen::MatrixXd& fixed_values, const std::vector<Real>& conductance) {
  return HarmonicSolver(vertices, topology, fixed).solve(fixed_values, conductance);
}

Points face_gradients(const Points& vertices, const Eigen::Matrix3Xi& faces, const Eigen::VectorXd& field) {
  Points gradients = Points::Zero(3, faces.cols());
  for (Index face = 0; face < faces.cols(); ++face) {
    const Vec3 normal = area_vector(vertices, faces.col(face));  // twice the area long
    const Real length2 = normal.squaredNorm();
    if (!(length2 > 0)) continue;
    for (int k = 0; k < 3; ++k) {
      const Vec3 opposite = vertices.col(faces((k + 2) % 3, face)) - vertices.col(faces((k + 1) % 3, face));
      gradients.col(face) += field[faces(k, face)] * normal.cross(opposite) / length2;
    }
  }
  return gradients;
}

}  // namespace gracilis
