#pragma once

#include <gracilis/core/types.hpp>

#include <Eigen/Eigenvalues>

namespace gracilis {

/// Directions of most, less and least spread of points, as columns.
inline Eigen::Matrix3d spread_axes(const Points& points) {
  const Points from = points.colwise() - points.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(from * from.transpose());
  return solver.eigenvectors().rowwise().reverse();
}

}  // namespace gracilis
