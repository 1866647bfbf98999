#pragma once

#include <gracilis/core/types.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gracilis {

/// Residuals at points of the unit cube, several at a time, for they may be computed side by side; none where a point
/// cannot be evaluated.
using ResidualFunction =
    std::function<std::vector<std::optional<Eigen::VectorXd>>(const std::vector<Eigen::VectorXd>& points)>;

struct LeastSquaresOptions {
  Real difference = 0.02;  ///< step of differences
  Real stop = 1e-4;        ///< relative change of the sum of squares, and length of a step, below which it ends
  Index most_points = 200;
};

struct SearchEnd {
  Eigen::VectorXd best;
  Real objective = 0;   ///< sum of squares there
  std::string stopped;  ///< why it ended there, in words
};

/// Levenberg and Marquardt's method within the unit cube from `start`: slopes by one-sided differences, all columns
/// side by side; two dampings are tried side by side. The points that it asks for do not depend on how many are
/// evaluated at once. Throws QualityError where the start cannot be evaluated.
SearchEnd least_squares(const ResidualFunction& residuals, const Eigen::VectorXd& start,
                        const LeastSquaresOptions& options);

/// Columns of slopes, d residuals / d place, by differences of `step` to both sides, as far as the cube goes and points
/// can be evaluated; 0 where neither can. `at` are the residuals at the point itself.
Eigen::MatrixXd central_slopes(const ResidualFunction& residuals, const Eigen::VectorXd& point,
                               const Eigen::VectorXd& at, Real step);

/// How well data determine parameters, from the curvature of the objective at its lowest point.
struct Uncertainty {
  Eigen::VectorXd errors;  ///< standard errors, as shares of the bounds; infinite where undetermined, nan: unknown
  Eigen::MatrixXd correlations;              ///< between parameters
  Real residual_variance = 0;                ///< of a residual, by the degrees of freedom that are left
  Index values = 0;                          ///< residuals
  std::vector<std::string> remarks;          ///< per parameter; empty: it is determined
  std::vector<std::vector<Index>> together;  ///< parameters that the data determine only in combination
};

/// By (JᵀJ)⁻¹ s², with s² = |r|² / (residuals - parameters), over parameters that are not at a bound. `slopes` J:
/// d residuals / d place. A direction along which the objective changes by less than it scatters when one goes through
/// all of the bounds is not determined. Source: Seber and Wild, Nonlinear Regression (1989), section 2.1.2.
Uncertainty uncertainty_at(const Eigen::VectorXd& place, const Eigen::VectorXd& residuals,
                           const Eigen::MatrixXd& slopes);

}  // namespace gracilis
