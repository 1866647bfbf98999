#pragma once

#include <gracilis/core/types.hpp>

#include <vector>

namespace gracilis::opensim {

/// A scalar function of coordinates as OpenSim's joints, constraints and paths use it, times `scale`.
struct Function {
  enum class Kind {
    constant,          ///< coefficients[0]
    linear,            ///< coefficients: one per argument, then the value at zero
    polynomial,        ///< of one argument; coefficients from the highest power down
    multivariate,      ///< polynomial of several arguments up to a total power; see monomials()
    spline,            ///< polynomial pieces between knots, of half as high an order beyond them
    piecewise_linear,  ///< straight between knots and beyond them
    sine,              ///< coefficients: amplitude, angular frequency, phase, offset
    product_of_sines   ///< coefficients: amplitude, then a phase for each argument
  };
  Kind kind = Kind::constant;
  std::vector<Real> coefficients = {0};
  std::vector<Real> knots;  ///< x, increasing
  /// Row i holds the Taylor coefficients at knot i: value, slope, half the second derivative and so on, an even number;
  /// the first half of them holds beyond the ends.
  Eigen::MatrixXd pieces;
  int dimension = 1, order = 0;  ///< multivariate
  Real scale = 1;
};

/// The same everywhere.
Function constant(Real value);
Function linear(Real slope, Real value_at_zero);  ///< slope x + value_at_zero

/// The cubic spline through (x, y) as SIMM and OpenSim's SimmSpline have it: at both ends the third derivative is that
/// of the cubic through the four outermost points; the parabola through three points, the line through two (Forsythe,
/// Malcolm, Moler 1977). x increases.
Function simm_spline(const std::vector<Real>& x, const std::vector<Real>& y);
/// The cubic spline through (x, y) with no curvature at its ends.
Function natural_spline(const std::vector<Real>& x, const std::vector<Real>& y);
/// Straight from point to point (x, y), and on beyond the ends. x increases; at least two points.
Function piecewise_linear(const std::vector<Real>& x, const std::vector<Real>& y);

/// amplitude sin(angular_frequency x + phase) + offset.
Function sine(Real amplitude, Real angular_frequency, Real phase, Real offset);

/// amplitude Π sin(x_i + phase_i).
Function product_of_sines(Real amplitude, const std::vector<Real>& phases);

/// The powers of a multivariate polynomial's terms, in the order of its coefficients: the last argument's power
/// varies fastest, and their sum never exceeds `order`.
std::vector<std::vector<int>> monomials(int dimension, int order);

/// The value at `arguments` (rad, m), and its partial derivatives by the arguments named in `by`, one after the other
/// (at most two). A function that takes fewer arguments ignores the others.
Real value(const Function& function, const std::vector<Real>& arguments);
/// The partial derivative, as `value` says.
Real derivative(const Function& function, const std::vector<Real>& arguments, const std::vector<int>& by);

}  // namespace gracilis::opensim
