#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/geometry/radial_kernel.hpp>

namespace gracilis {

/// A polynomial added to radial basis functions (Cervenka 2024, section 3.1.2).
enum class RadialPolynomial { none, constant, linear };

/// \f$f(x) = \sum_i \lambda_i \varphi(|x - \xi_i|) + a_0 + a \cdot (x - o) / l\f$ (Cervenka 2024, eqs. 3.1 and 6.1). In
/// 1 or 2 `dimensions` the other coordinates are 0 everywhere.
struct RadialBasis {
  RadialKernel kernel;
  Points centers = Points(3, 0);  ///< ξ, m
  Eigen::VectorXd reaches;        ///< m, per center
  Eigen::VectorXd weights;        ///< λ
  Eigen::VectorXd polynomial;     ///< a_0, then a as far as there is one
  Vec3 origin = Vec3::Zero();     ///< o, m
  Real size = 1;                  ///< l, m
  int dimensions = 3;

  Index count() const { return static_cast<Index>(centers.cols()); }  ///< of centers
};

/// Value and derivatives of f.
struct RadialSample {
  Real value = 0;
  Vec3 gradient = Vec3::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();  ///< infinite at centers of kernels without a second derivative
};

/// Closed forms (Cervenka 2024, eqs. 6.2 and 6.4, whose off-diagonals need r_ij r_ik). At a center the gradient of a
/// kernel with a kink there is taken for 0.
RadialSample sample(const RadialBasis& basis, const Vec3& point);

/// f alone.
Real value_at(const RadialBasis& basis, const Vec3& point);

/// f less the value that it should have, at each point.
Eigen::VectorXd errors_at(const RadialBasis& basis, const Points& points, const Eigen::VectorXd& values);

/// f and its gradient alone.
RadialSample slope_at(const RadialBasis& basis, const Vec3& point);

/// Mean eigenvalue of the Hessian (Cervenka 2024, eq. 6.5), what the report calls mean curvature: the field's Laplacian
/// over the number of dimensions, not the curvature of its surfaces.
Real field_curvature(const RadialBasis& basis, const Vec3& point);

/// Mean curvature of the surface f = const through the point in three dimensions, 1/m: half the divergence of the unit
/// gradient (Goldman 2005); 1/r for a sphere whose f grows outwards.
Real surface_mean_curvature(const RadialSample& sample);

}  // namespace gracilis
