#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis {

/// Eigenvalues of a symmetric matrix, ascending, and the directions that belong to them.
struct PrincipalAxes {
  Vec3 values;
  Eigen::Matrix3d directions;  ///< orthonormal columns; signs are arbitrary

  Vec3 least() const { return directions.col(0); }  ///< unit, where it extends least
  Vec3 most() const { return directions.col(2); }   ///< unit, where it extends most
};

/// Precondition: symmetric and finite; the lower half is read.
PrincipalAxes principal_axes(const Eigen::Matrix3d& symmetric);

/// In which directions points spread: of the sum of (x - mean) (x - mean)ᵀ, m². Precondition: at least one point.
PrincipalAxes spread_of(const Points& points);

}  // namespace gracilis
