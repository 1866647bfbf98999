#pragma once

#include <gracilis/geometry/radial_basis.hpp>

#include <vector>

/// How much a moved sum of radial basis functions differs in curvature from what it was (Cervenka 2024, chapter 6).
namespace gracilis::rbf {

/// Where curvatures are compared: the points that stand for the integral over space.
struct CurvaturePoints {
  Points points;               ///< m
  Eigen::VectorXd curvatures;  ///< wanted there, 1/m
  Real share = 1;              ///< of space that each stands for, m³
};

/// \f$C = \sum s (\kappa(x) - \kappa_0(x))^2\f$, κ the field's curvature, s a point's share (eq. 6.6). m.
Real curvature_cost(const RadialBasis& basis, const CurvaturePoints& wanted);

/// Its gradient by the centers (eqs. 6.8 to 6.10), 3 × n. Precondition: a kernel with three derivatives at its center.
Points curvature_cost_gradient(const RadialBasis& basis, const CurvaturePoints& wanted);

/// What a descent did.
struct Descent {
  Real before = 0, after = 0;  ///< cost
  int steps = 0;               ///< that lowered it
};

/// Moves the free centers down the gradient, at most `most_steps` times, each step shortened by halves until it lowers
/// the cost (Armijo 1966); no center by more than `longest_step` (m) at once. `is_free` is per center.
Descent descend(RadialBasis& basis, const CurvaturePoints& wanted, const std::vector<char>& is_free, int most_steps,
                Real longest_step);

}  // namespace gracilis::rbf
