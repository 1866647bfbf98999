#include <gracilis/methods/tissue/factored_matrix.hpp>

#include <gracilis/core/errors.hpp>

#include <Eigen/SparseCholesky>

namespace gracilis::tissue {

FactoredMatrix::FactoredMatrix(const Eigen::SparseMatrix<Real>& matrix) {
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<Real>> factorization(matrix);
  if (factorization.info() != Eigen::Success)
    throw QualityError(
        "the stiffness of a muscle's tissue is not positive definite, so no step can be solved for: its "
        "settings leave it without stiffness somewhere, or its shape is not finite");
  lower_ = Eigen::SparseMatrix<Real>(factorization.matrixL()).cast<float>();
  lower_.makeCompressed();
  const auto& to_matrix = factorization.permutationPinv().indices();
  order_.resize(static_cast<std::size_t>(matrix.rows()));
  for (Index row = 0; row < static_cast<Index>(matrix.rows()); ++row)
    order_[static_cast<std::size_t>(row)] = to_matrix.size() > 0 ? to_matrix[row] : row;
}

/// Reading the factor takes most of the time, so several right sides take hardly longer than one.
template <Index Count>
void FactoredMatrix::solve_together(std::span<Points> bs) const {
  // Four numbers a point, so that they fill whole vector registers.
  using Column = Eigen::Matrix<float, 4 * Count, 1>;
  const auto n = static_cast<Index>(order_.size());
  Eigen::Matrix<float, 4 * Count, Eigen::Dynamic> x =
      Eigen::Matrix<float, 4 * Count, Eigen::Dynamic>::Zero(4 * Count, n);
  for (Index i = 0; i < n; ++i)
    for (Index k = 0; k < Count; ++k)
      x.col(i).template segment<3>(4 * k) =
          bs[static_cast<std::size_t>(k)].col(order_[static_cast<std::size_t>(i)]).template cast<float>();
  const auto* begin = lower_.outerIndexPtr();
  const auto* rows = lower_.innerIndexPtr();
  const float* values = lower_.valuePtr();
  for (Index j = 0; j < n; ++j) {
    const Column at = x.col(j) / values[begin[j]];
    x.col(j) = at;
    for (Index k = begin[j] + 1; k < begin[j + 1]; ++k) x.col(rows[k]) -= values[k] * at;
  }
  for (Index j = n - 1; j >= 0; --j) {
    Column at = x.col(j);
    for (Index k = begin[j] + 1; k < begin[j + 1]; ++k) at -= values[k] * x.col(rows[k]);
    x.col(j) = at / values[begin[j]];
  }
  for (Index i = 0; i < n; ++i)
    for (Index k = 0; k < Count; ++k)
      bs[static_cast<std::size_t>(k)].col(order_[static_cast<std::size_t>(i)]) =
          x.col(i).template segment<3>(4 * k).template cast<Real>();
}

void FactoredMatrix::solve(std::span<Points> bs) const {
  for (; bs.size() > 1; bs = bs.subspan(2)) solve_together<2>(bs.first(2));
  if (!bs.empty()) solve_together<1>(bs);
}

}  // namespace gracilis::tissue
