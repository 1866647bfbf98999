#include <gracilis/methods/tissue/factored_matrix.hpp>

#include <Eigen/SparseCholesky>

#include <cassert>

namespace gracilis::tissue {

FactoredMatrix::FactoredMatrix(const Eigen::SparseMatrix<Real>& matrix) {
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<Real>> factorization(matrix);
  assert(factorization.info() == Eigen::Success);
  lower_ = Eigen::SparseMatrix<Real>(factorization.matrixL()).cast<float>();
  lower_.makeCompressed();
  const auto& to_matrix = factorization.permutationPinv().indices();
  order_.resize(static_cast<std::size_t>(matrix.rows()));
  for (Index row = 0; row < static_cast<Index>(matrix.rows()); ++row)
    order_[static_cast<std::size_t>(row)] = to_matrix.size() > 0 ? to_matrix[row] : row;
}

Points FactoredMatrix::solve(const Points& b) const {
  // Four numbers a point, so that each fills a vector register.
  Eigen::Matrix4Xf x = Eigen::Matrix4Xf::Zero(4, b.cols());
  for (Index i = 0; i < static_cast<Index>(b.cols()); ++i)
    x.col(i).head<3>() = b.col(order_[static_cast<std::size_t>(i)]).cast<float>();
  const auto* begin = lower_.outerIndexPtr();
  const auto* rows = lower_.innerIndexPtr();
  const float* values = lower_.valuePtr();
  for (Index j = 0; j < static_cast<Index>(b.cols()); ++j) {
    const Eigen::Vector4f at = x.col(j) / values[begin[j]];
    x.col(j) = at;
    for (Index k = begin[j] + 1; k < begin[j + 1]; ++k) x.col(rows[k]) -= values[k] * at;
  }
  for (Index j = static_cast<Index>(b.cols()) - 1; j >= 0; --j) {
    Eigen::Vector4f at = x.col(j);
    for (Index k = begin[j] + 1; k < begin[j + 1]; ++k) at -= values[k] * x.col(rows[k]);
    x.col(j) = at / values[begin[j]];
  }
  Points result(3, b.cols());
  for (Index i = 0; i < static_cast<Index>(b.cols()); ++i)
    result.col(order_[static_cast<std::size_t>(i)]) = x.col(i).head<3>().cast<Real>();
  return result;
}

}  // namespace gracilis::tissue
