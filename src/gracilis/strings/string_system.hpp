#pragma once

#include <gracilis/core/types.hpp>

#include <vector>

namespace gracilis::strings {

/// The block tridiagonal system of one string's inner nodes: H_i x_i - k (x_{i-1} + x_{i+1}) = -g_i, with the ends at
/// rest.
struct StringSystem {
  /// For a string of so many nodes, ends included.
  explicit StringSystem(Index nodes);

  Real tension = 0;                        ///< k, 1/m
  std::vector<Eigen::Matrix3d> stiffness;  ///< H, per node
  std::vector<Vec3> gradient;              ///< g
  std::vector<Vec3> solution;              ///< x, m

  /// Adds k n nᵀ and k e n: a spring along n, stretched by e.
  void add_spring(Index node, Real stiffness, const Vec3& direction, Real stretch);
  /// By block elimination (Thomas). Precondition: positive definite.
  void solve();

 private:
  std::vector<Eigen::Matrix3d> inverse_;
};

}  // namespace gracilis::strings
