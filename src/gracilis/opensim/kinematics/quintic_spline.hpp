#pragma once

#include <gracilis/core/types.hpp>

#include <vector>

namespace gracilis::opensim {

/// Smooth functions through samples: of all functions through them the one with the least square of the third
/// derivative, pieces of fifth degree (what OpenSim's GCVSpline of degree 5 is without smoothing; Woltring 1986).
struct QuinticSpline {
  std::vector<Real> times;             ///< s, increasing
  Eigen::MatrixXd values;              ///< a row per time, a column per function
  Eigen::MatrixXd slopes, curvatures;  ///< first and second derivatives at the times
};

/// Through `values` (a row per time). Throws InputError for less than 6 rows, for two rows closer than a millionth of
/// the mean step, and where speeds or accelerations come out not finite.
QuinticSpline quintic_spline(const std::vector<Real>& times, const Eigen::MatrixXd& values);

/// All functions at `time`; beyond the samples the outermost piece goes on.
Eigen::VectorXd evaluate(const QuinticSpline& spline, Real time);

}  // namespace gracilis::opensim
