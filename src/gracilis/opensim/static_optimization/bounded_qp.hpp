#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis::opensim {

/// Minimize Σ w_i (x_i - c_i)² / 2 where A x = b and lower <= x <= upper.
struct BoundedQp {
  Eigen::MatrixXd a;
  Eigen::VectorXd b;
  Eigen::VectorXd weights, centers;  ///< weights positive
  Eigen::VectorXd lower, upper;      ///< may be infinite
};

struct BoundedQpSolution {
  Eigen::VectorXd x;
  Eigen::VectorXd missing;  ///< b - A x: of rounding size, or the least that no x within the bounds can make up
  bool feasible = false;
};

/// Solves the dual problem, whose unknowns are as few as rows: minimized by Newton's method with proximal steps
/// (Rockafellar 1976), which converge for problems without a solution, too, to the least missing b in the norm of rows
/// scaled alike. `tolerance` is the missing part, over the row's largest possible sum, that counts as none.
BoundedQpSolution solve(const BoundedQp& problem, Real tolerance = 1e-7);

/// Minimizes Σ |x_i|^power (power > 1) under the same constraints, by quadratic problems one after the other; starts at
/// the solution for power 2. `problem.weights` and `centers` are not looked at.
BoundedQpSolution minimize_powers(BoundedQp problem, Real power);

}  // namespace gracilis::opensim
