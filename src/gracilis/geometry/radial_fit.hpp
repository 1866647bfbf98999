#pragma once

#include <gracilis/geometry/radial_basis.hpp>

namespace gracilis {

/// Radial basis functions fitted to values at points.
struct RadialFit {
  RadialBasis basis;
  Real condition = 0;  ///< estimated condition number of the system that was solved (of its least squares matrix)
  Real largest_residual = 0;  ///< at the points, in the unit of the values
};

/// What functions are fitted with.
struct RadialFitSettings {
  RadialKernel kernel;
  RadialPolynomial polynomial = RadialPolynomial::none;
  int dimensions = 3;
};

/// The functions centered at the points themselves that take the values there, with weights that no polynomial of the
/// added kind sees (Cervenka 2024, section 3.1.2). Kernels that end at their reach (m) are solved by sparse matrices,
/// others densely: n³ / 3 steps. Condition numbers are in the 1-norm where dense, 2-norm where sparse. Throws
/// InputError where the system is singular to working precision: points that coincide, a kernel that is itself a
/// polynomial, or one that hardly falls from point to point. Precondition: as many values as points, at least one.
RadialFit interpolate(const RadialFitSettings& settings, const Points& points, Real reach,
                      const Eigen::VectorXd& values);

/// The functions centered at `centers`, a reach (m) each, nearest to the values at the points in the sense of least
/// squares, each point with its `point_weights` (empty: 1). Householder reflections, 2 m n² steps for m points and n
/// centers. Throws InputError where the columns depend on each other to working precision, and where there are fewer
/// points than unknowns.
RadialFit fit_least_squares(const RadialFitSettings& settings, const Points& centers, const Eigen::VectorXd& reaches,
                            const Points& points, const Eigen::VectorXd& values,
                            const Eigen::VectorXd& point_weights = {});

/// Condition number, in the 1-norm, of the dense interpolation matrix at these points: for maps of it. Infinite where
/// it is singular.
Real interpolation_condition(const RadialFitSettings& settings, const Points& points, Real reach);

}  // namespace gracilis
