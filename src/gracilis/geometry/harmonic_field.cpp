#include <gracilis/geometry/harmonic_field.hpp>

#include <gracilis/geometry/measures.hpp>

#include <Eigen/IterativeLinearSolvers>

#include <algorithm>
#include <utility>

namespace gracilis {

static constexpr Real shortest_edge = 1e-9;
/// Of conjugate gradients, relative.
static constexpr Real harmonic_residual = 1e-8;

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

HarmonicSolver::HarmonicSolver(const Points& vertices, const MeshTopology& topology, std::vector<Index> fixed,
                               Index largest_factorized)
    : vertices_(vertices), topology_(topology), fixed_(std::move(fixed)), largest_factorized_(largest_factorized) {
  numbers_ = number_unknowns(topology, fixed_, unknown_count_);
}

Eigen::SparseMatrix<Real> HarmonicSolver::empty_laplacian() const {
  Eigen::VectorXi sizes = Eigen::VectorXi::Ones(unknown_count_);
  for (const MeshEdge& edge : topology_.edges)
    for (const auto& [vertex, other] : {std::pair{edge.a, edge.b}, std::pair{edge.b, edge.a}}) {
      const Index row = number_of(vertex), column = number_of(other);
      if (row >= 0 && column >= 0 && is_read(row, column)) ++sizes[column];
    }
  Eigen::SparseMatrix<Real> laplacian(unknown_count_, unknown_count_);
  laplacian.reserve(sizes);
  return laplacian;
}

/// Each field from where the last one ended; where all sum to one, the last from what the others leave.
Eigen::MatrixXd HarmonicSolver::iterated(const Eigen::SparseMatrix<Real>& laplacian, const Eigen::MatrixXd& right_side,
                                         bool sums_to_one) {
  Eigen::ConjugateGradient<Eigen::SparseMatrix<Real>, Eigen::Lower | Eigen::Upper> iteration(laplacian);
  iteration.setTolerance(harmonic_residual);
  iteration.setMaxIterations(unknown_count_);
  const Index last = static_cast<Index>(right_side.cols()) - 1;
  if (last_.cols() != right_side.cols()) last_ = Eigen::MatrixXd::Zero(unknown_count_, right_side.cols());
  for (Index k = 0; k <= last; ++k) {
    if (k == last && sums_to_one) last_.col(k) = 1 - last_.leftCols(last).rowwise().sum().array();
    last_.col(k) = iteration.solveWithGuess(right_side.col(k), last_.col(k)).eval();
  }
  return last_;
}

/// Harmonic values lie between the fixed ones; what is iterated may miss that by the residual.
static void keep_between(const Eigen::MatrixXd& fixed_values, Eigen::MatrixXd& fields) {
  for (Index k = 0; k < fields.cols(); ++k)
    fields.col(k) = fields.col(k).cwiseMax(fixed_values.col(k).minCoeff()).cwiseMin(fixed_values.col(k).maxCoeff());
}

Eigen::MatrixXd HarmonicSolver::solve(const Eigen::MatrixXd& fixed_values, const std::vector<Real>& conductance) {
  Eigen::MatrixXd fields = Eigen::MatrixXd::Zero(vertices_.cols(), fixed_values.cols());
  for (std::size_t i = 0; i < fixed_.size(); ++i) fields.row(fixed_[i]) = fixed_values.row(static_cast<Index>(i));
  if (unknown_count_ == 0) return fields;

  Eigen::SparseMatrix<Real> laplacian = empty_laplacian();
  Eigen::MatrixXd right_side = Eigen::MatrixXd::Zero(unknown_count_, fixed_values.cols());
  for (std::size_t e = 0; e < topology_.edges.size(); ++e) {
    const MeshEdge& edge = topology_.edges[e];
    const Real length = std::max((vertices_.col(edge.a) - vertices_.col(edge.b)).norm(), shortest_edge);
    const Real weight = (conductance.empty() ? 1 : conductance[e]) / length;
    for (const auto& [vertex, other] : {std::pair{edge.a, edge.b}, std::pair{edge.b, edge.a}}) {
      const Index row = number_of(vertex), column = number_of(other);
      if (row < 0) continue;
      laplacian.coeffRef(row, row) += weight;
      if (column < 0)
        right_side.row(row) += weight * fields.row(other);
      else if (is_read(row, column))
        laplacian.coeffRef(row, column) -= weight;
    }
  }
  laplacian.makeCompressed();
  Eigen::MatrixXd solution;
  if (is_factorized()) {
    factors_.factor(laplacian,
                    "harmonic fields of a surface have no solution: its vertices are not finite, or far too large or "
                    "small");
    solution = factors_.solve(right_side);
  } else {
    solution = iterated(laplacian, right_side, (fixed_values.rowwise().sum().array() == 1).all());
  }
  keep_between(fixed_values, solution);
  for (Index v = 0; v < vertices_.cols(); ++v)
    if (number_of(v) >= 0) fields.row(v) = solution.row(number_of(v));
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
