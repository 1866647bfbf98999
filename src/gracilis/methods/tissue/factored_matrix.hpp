#pragma once

#include <gracilis/core/types.hpp>

#include <Eigen/SparseCore>

#include <vector>

namespace gracilis::tissue {

/// A symmetric positive definite matrix, factored once, by which points are solved for all three coordinates at once.
class FactoredMatrix {
 public:
  FactoredMatrix() = default;
  explicit FactoredMatrix(const Eigen::SparseMatrix<Real>& matrix);

  bool empty() const { return order_.empty(); }
  /// The points x with matrix · xᵀ = bᵀ, 3 × n, in single precision.
  Points solve(const Points& b) const;

 private:
  Eigen::SparseMatrix<float> lower_;  ///< Cholesky's factor, column by column, the diagonal first in each
  std::vector<Index> order_;          ///< row of the factor → row of the matrix
};

}  // namespace gracilis::tissue
