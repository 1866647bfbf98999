#include <gracilis/geometry/sparse_ldlt.hpp>

#include <gracilis/core/errors.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace gracilis {
namespace {

/// A chain of springs, held at its first node by `grip`.
Eigen::SparseMatrix<Real> chain(Index count, Real grip) {
  Eigen::SparseMatrix<Real> matrix(count, count);
  matrix.coeffRef(0, 0) += grip;
  for (Index i = 0; i + 1 < count; ++i) {
    matrix.coeffRef(i, i) += 1, matrix.coeffRef(i + 1, i + 1) += 1;
    matrix.coeffRef(i, i + 1) -= 1, matrix.coeffRef(i + 1, i) -= 1;
  }
  matrix.makeCompressed();
  return matrix;
}

}  // namespace

TEST(SparseLdlt, what_it_solves_for_gives_the_right_side_again_also_with_other_values_in_the_same_places) {
  SparseLdlt factors;
  for (const Real grip : {1.0, 0.01}) {
    const Eigen::SparseMatrix<Real> matrix = chain(50, grip);
    factors.factor(matrix, "no solution");
    const Eigen::MatrixXd right = Eigen::MatrixXd::Random(50, 2);
    EXPECT_LT((matrix * factors.solve(right) - right).norm(), 1e-10 * right.norm()) << grip;
  }
}

TEST(SparseLdlt, solves_for_points_as_for_their_coordinates_one_by_one) {
  SparseLdlt factors;
  factors.factor(chain(50, 1), "no solution");
  const Points right = Points::Random(3, 50);
  const Eigen::MatrixXd one_by_one = factors.solve(right.transpose());
  EXPECT_LT((factors.solve_points(right).transpose() - one_by_one).norm(), 1e-12 * one_by_one.norm());
}

TEST(SparseLdlt, a_matrix_without_a_solution_is_an_error_in_the_words_given) {
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  for (const Real grip : {0.0, nan}) {
    SparseLdlt factors;
    try {
      factors.factor(chain(3, grip), "nothing holds the chain");
      ADD_FAILURE() << grip;
    } catch (const QualityError& error) {
      EXPECT_STREQ(error.what(), "nothing holds the chain");
    }
  }
}

}  // namespace gracilis
