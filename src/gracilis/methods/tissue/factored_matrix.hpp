#pragma once

#include <gracilis/core/types.hpp>

#include <Eigen/SparseCore>

#include <span>
#include <vector>

namespace gracilis::tissue {

/// A symmetric positive definite matrix, factored once, by which points are solved for all their coordinates at once.
class FactoredMatrix {
 public:
  FactoredMatrix() = default;
  /// Throws QualityError where the matrix is not positive definite.
  explicit FactoredMatrix(const Eigen::SparseMatrix<Real>& matrix);

  bool empty() const { return order_.empty(); }  ///< nothing has been factored
  /// Replaces each b by the points x with matrix · xᵀ = bᵀ, 3 × n, in single precision.
  void solve(std::span<Points> bs) const;

 private:
  template <Index Count>
  void solve_together(std::span<Points> bs) const;

  Eigen::SparseMatrix<float> lower_;  ///< Cholesky's factor, column by column, the diagonal first in each
  std::vector<Index> order_;          ///< row of the factor → row of the matrix
};

}  // namespace gracilis::tissue
