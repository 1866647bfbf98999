#pragma once

#include <gracilis/opensim/functions/function.hpp>

namespace gracilis::opensim {

/// A muscle's lengths in poses and, where they are known, how these change with each of its coordinates.
struct PathSamples {
  Eigen::MatrixXd coordinates;  ///< poses × coordinates, rad or m
  Eigen::VectorXd lengths;      ///< m
  Eigen::MatrixXd arms = {};    ///< -dL/dq, as large as `coordinates`, m (of translations 1); empty: not known
  /// Per coordinate: what a change of it counts for beside a length, so that arms times this are in m. 1 rad for
  /// angles; of translations a length, such as half of their range. Empty: all are angles.
  Eigen::VectorXd scales = {};

  /// Of one coordinate.
  Real scale(Eigen::Index coordinate) const { return scales.size() > 0 ? scales[coordinate] : 1; }
};

/// How far lengths and arms of a function are from those of samples, m; arms times scales. Of all arms together.
struct PathErrors {
  Real length_root_mean_square = 0, length_largest = 0;
  Real arm_root_mean_square = 0, arm_largest = 0;  ///< 0 where the samples know no arms
};

/// The errors of a multivariate polynomial.
PathErrors path_errors(const Function& function, const PathSamples& samples);

/// Per coordinate the root mean square of arms' errors, m per rad (of translations 1); empty where arms are not known.
Eigen::VectorXd arm_errors(const Function& function, const PathSamples& samples);

/// The sum of two multivariate polynomials of the same arguments.
Function sum_of(const Function& a, const Function& b);

}  // namespace gracilis::opensim
