#pragma once

#include <gracilis/core/types.hpp>

#include <Eigen/SparseCore>

#include <memory>

namespace gracilis {

/// Factors LDLᵀ of symmetric sparse matrices, by Eigen. Its headers take a compiler seconds, so they are read here
/// alone.
class SparseLdlt {
 public:
  SparseLdlt();
  ~SparseLdlt();
  /// One that is moved from may only be assigned to or destroyed.
  SparseLdlt(SparseLdlt&&) noexcept;
  SparseLdlt& operator=(SparseLdlt&&) noexcept;  ///< as the constructor

  /// Only the lower half of the matrix is read. Matrices after the first have its pattern, which is looked at once.
  /// Throws QualityError, which says `failure`, where a pivot is zero or not finite.
  void factor(const Eigen::SparseMatrix<Real>& matrix, const char* failure);

  /// x with matrix · x = right, column by column. Precondition: factored.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;

  /// The same for points, a column per unknown: of one surface (3 rows) or two (6). All rows at once: the factors come
  /// from memory once, not once for each.
  template <int Rows>
  Eigen::Matrix<Real, Rows, Eigen::Dynamic> solve_points(const Eigen::Matrix<Real, Rows, Eigen::Dynamic>& right) const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace gracilis
