#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/radial_kernel.hpp>

#include <Eigen/SparseCore>

#include <memory>

namespace gracilis {

/// Systems A λ = v with A_ij = φ(|ξ_i - ξ_j|) of a kernel that ends at its reach. Positive definite ones are solved by
/// conjugate gradients, whose memory is twice that of A; others (kernels of too few dimensions) by sparse factors.
class SparseKernelSolver {
 public:
  /// Precondition: is_compact(kernel), reach > 0.
  SparseKernelSolver(const RadialKernel& kernel, const Points& centers, Real reach);
  ~SparseKernelSolver();

  /// To 1e-14 of the right side, or as far as rounding lets it come.
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;
  Eigen::VectorXd times(const Eigen::VectorXd& x) const;  ///< A x
  /// In the 2-norm, estimated from below by powers of A and its inverse. Infinite where A is singular.
  Real condition() const { return condition_; }

 private:
  struct Factors;
  using Matrix = Eigen::SparseMatrix<Real, Eigen::RowMajor>;

  Matrix matrix_;
  std::unique_ptr<Factors> factors_;
  Real condition_ = 0;
};

}  // namespace gracilis
