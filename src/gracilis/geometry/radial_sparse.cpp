#include <gracilis/geometry/radial_sparse.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/core/stop.hpp>
#include <gracilis/geometry/nearest_points.hpp>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseLU>

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace gracilis {

namespace {

using Matrix = Eigen::SparseMatrix<Real, Eigen::RowMajor>;
using Vector = Eigen::VectorXd;

Vector product(const Matrix& matrix, const Vector& x) {
  Vector result(matrix.rows());
  parallel_for(static_cast<Index>(matrix.rows()), 1024, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      Real sum = 0;
      for (Matrix::InnerIterator at(matrix, i); at; ++at) sum += at.value() * x[at.col()];
      result[i] = sum;
    }
  });
  return result;
}

Matrix kernel_matrix(const RadialKernel& kernel, const Points& centers, Real reach) {
  const auto n = static_cast<Index>(centers.cols());
  const NearestPoints tree(centers);
  std::vector<std::vector<Index>> near(static_cast<std::size_t>(n));
  parallel_for(n, 256, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) near[static_cast<std::size_t>(i)] = tree.within(centers.col(i), reach);
  });
  Matrix matrix(n, n);
  Eigen::VectorXi sizes(n);
  for (Index i = 0; i < n; ++i) sizes[i] = static_cast<int>(near[static_cast<std::size_t>(i)].size());
  matrix.reserve(sizes);
  for (Index i = 0; i < n; ++i)
    for (const Index j : near[static_cast<std::size_t>(i)])
      matrix.insert(i, j) = radial_value(kernel, reach, (centers.col(i) - centers.col(j)).norm());
  matrix.makeCompressed();
  return matrix;
}

using Preconditioner = Eigen::IncompleteCholesky<Real>;

/// Conjugate gradients (Hestenes and Stiefel 1952) behind incomplete factors, until the residual is `accuracy` of the
/// right side or rounding lets it fall no further; nothing where a direction shows that A is not positive definite.
std::optional<Vector> conjugate_gradients(const Matrix& matrix, const Preconditioner& factors, const Vector& right,
                                          Real accuracy) {
  constexpr int longest_stand = 200;
  Vector x = Vector::Zero(right.size()), residual = right, towards = factors.solve(residual), way = towards, best = x;
  Real product_now = residual.dot(towards), least = residual.squaredNorm();
  const Real target = accuracy * accuracy * least;
  for (int since_best = 0; least > target && since_best < longest_stand; ++since_best) {
    throw_if_stopped();
    const Vector moved = product(matrix, way);
    const Real bend = way.dot(moved);
    if (!(bend > 0)) return std::nullopt;
    const Real step = product_now / bend;
    x += step * way;
    residual -= step * moved;
    towards = factors.solve(residual);
    const Real next = residual.dot(towards), square = residual.squaredNorm();
    way = towards + next / product_now * way;
    product_now = next;
    if (square < least) least = square, best = x, since_best = 0;
  }
  return best;
}

/// An uneven vector that no symmetry of the centers is orthogonal to, the same each time.
Vector uneven(Eigen::Index n) {
  Vector v(n);
  for (Eigen::Index i = 0; i < n; ++i) v[i] = std::sin(1.0 + 12.9898 * static_cast<Real>(i % 1000003));
  return v;
}

}  // namespace

struct SparseKernelSolver::Factors {
  Preconditioner incomplete;
  Eigen::SparseLU<Eigen::SparseMatrix<Real>> whole;
  bool is_definite = true;
  bool is_sound = true;

  /// A⁻¹ v to `accuracy` of v.
  Vector solve(const Matrix& matrix, const Vector& v, Real accuracy) {
    if (is_definite) {
      if (const auto found = conjugate_gradients(matrix, incomplete, v, accuracy)) return *found;
      is_definite = false;
      whole.compute(Eigen::SparseMatrix<Real>(matrix));
      is_sound = whole.info() == Eigen::Success;
    }
    return is_sound ? Vector(whole.solve(v)) : Vector::Zero(v.size());
  }
};

SparseKernelSolver::~SparseKernelSolver() = default;

SparseKernelSolver::SparseKernelSolver(const RadialKernel& kernel, const Points& centers, Real reach)
    : matrix_(kernel_matrix(kernel, centers, reach)), factors_(std::make_unique<Factors>()) {
  factors_->incomplete.compute(Eigen::SparseMatrix<Real>(matrix_));
  // Powers of A and of its inverse tend to the vectors of its largest and least eigenvalue.
  constexpr int most_powers = 30;
  constexpr Real settled = 1e-3, accuracy = 1e-4;
  Vector vector = uneven(matrix_.rows()).normalized();
  Real largest = 0, least = 0;
  for (int i = 0; i < most_powers; ++i) {
    vector = product(matrix_, vector);
    largest = vector.norm();
    vector /= largest;
  }
  vector = uneven(matrix_.rows()).normalized();
  for (int i = 0; i < most_powers; ++i) {
    const Vector next = factors_->solve(matrix_, vector, accuracy);
    const Real before = least;
    least = 1 / next.norm();
    if (!std::isfinite(least)) break;
    vector = next * least;
    if (std::abs(least - before) <= settled * least) break;
  }
  condition_ =
      factors_->is_sound && least > 0 && std::isfinite(least) ? largest / least : std::numeric_limits<Real>::infinity();
}

Eigen::VectorXd SparseKernelSolver::solve(const Eigen::VectorXd& right) const {
  constexpr Real accuracy = 1e-14;
  constexpr int most_rounds = 3;
  Vector x = factors_->solve(matrix_, right, accuracy);
  // What the recurrence believes and what is left part by rounding; further solves take the rest.
  for (int i = 1; i < most_rounds; ++i) {
    const Vector left = right - product(matrix_, x);
    if (!(left.norm() > accuracy * right.norm())) break;
    x += factors_->solve(matrix_, left, accuracy);
  }
  return x;
}

Eigen::VectorXd SparseKernelSolver::times(const Eigen::VectorXd& x) const { return product(matrix_, x); }

}  // namespace gracilis
