#include <gracilis/geometry/sparse_ldlt.hpp>

#include <gracilis/core/errors.hpp>

#include <Eigen/SparseCholesky>

namespace gracilis {

struct SparseLdlt::Factors {
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<Real>> ldlt;
  bool is_analyzed = false;
};

SparseLdlt::SparseLdlt() = default;
SparseLdlt::~SparseLdlt() = default;
SparseLdlt::SparseLdlt(SparseLdlt&&) noexcept = default;
SparseLdlt& SparseLdlt::operator=(SparseLdlt&&) noexcept = default;

void SparseLdlt::factor(const Eigen::SparseMatrix<Real>& matrix, const char* failure) {
  if (!factors_) factors_ = std::make_unique<Factors>();
  if (!factors_->is_analyzed) factors_->ldlt.analyzePattern(matrix);
  factors_->is_analyzed = true;
  factors_->ldlt.factorize(matrix);
  // Eigen tells of zero pivots alone.
  if (factors_->ldlt.info() != Eigen::Success || !factors_->ldlt.vectorD().allFinite()) throw QualityError(failure);
}

Eigen::MatrixXd SparseLdlt::solve(const Eigen::MatrixXd& right) const { return factors_->ldlt.solve(right); }

template <int Rows>
Eigen::Matrix<Real, Rows, Eigen::Dynamic> SparseLdlt::solve_points(
    const Eigen::Matrix<Real, Rows, Eigen::Dynamic>& right) const {
  using Column = Eigen::Matrix<Real, Rows, 1>;
  const auto& lower = factors_->ldlt.matrixL().nestedExpression();
  const auto* const begin = lower.outerIndexPtr();
  const auto* const rows = lower.innerIndexPtr();
  const Real* const values = lower.valuePtr();
  const auto& order = factors_->ldlt.permutationP().indices();
  const Eigen::VectorXd& diagonal = factors_->ldlt.vectorD();
  const auto n = static_cast<Index>(right.cols());
  Eigen::Matrix<Real, Rows, Eigen::Dynamic> x(Rows, n), solution(Rows, n);
  for (Index i = 0; i < n; ++i) x.col(order[i]) = right.col(i);
  for (Index i = 0; i < n; ++i) {
    const Column own = x.col(i);
    for (auto k = begin[i]; k < begin[i + 1]; ++k) x.col(rows[k]) -= values[k] * own;
  }
  for (Index i = n - 1; i >= 0; --i) {
    Column own = x.col(i) * (1 / diagonal[i]);
    for (auto k = begin[i]; k < begin[i + 1]; ++k) own -= values[k] * x.col(rows[k]);
    x.col(i) = own;
  }
  for (Index i = 0; i < n; ++i) solution.col(i) = x.col(order[i]);
  return solution;
}

template Points SparseLdlt::solve_points(const Points&) const;
template Eigen::Matrix<Real, 6, Eigen::Dynamic> SparseLdlt::solve_points(
    const Eigen::Matrix<Real, 6, Eigen::Dynamic>&) const;

}  // namespace gracilis
