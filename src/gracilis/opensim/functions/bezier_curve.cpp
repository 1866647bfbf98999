#include <gracilis/opensim/functions/bezier_curve.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::opensim {

using ControlPoints = Eigen::Vector<Real, 6>;

void add_corner(BezierCurve& curve, const CurveEnd& from, const CurveEnd& to, Real curviness) {
  const Real turn = from.slope - to.slope;
  const Real corner_x =
      std::abs(turn) > 1.5e-8 ? (to.y - from.y - to.x * to.slope + from.x * from.slope) / turn : (from.x + to.x) / 2;
  const Real corner_y = to.y + (corner_x - to.x) * to.slope;
  const Real c = 0.1 + 0.8 * curviness;  // as OpenSim scales it
  const auto points = [c](Real begin, Real corner, Real end) {
    ControlPoints p;
    p << begin, begin + c * (corner - begin), begin + c * (corner - begin), end + c * (corner - end),
        end + c * (corner - end), end;
    return p;
  };
  const Eigen::Index piece = curve.x.cols();
  if (piece == 0) curve.first_slope = from.slope;
  curve.last_slope = to.slope;
  curve.x.conservativeResize(Eigen::NoChange, piece + 1);
  curve.y.conservativeResize(Eigen::NoChange, piece + 1);
  curve.x.col(piece) = points(from.x, corner_x, to.x);
  curve.y.col(piece) = points(from.y, corner_y, to.y);
}

/// By de Casteljau's steps: the value at u, and the derivative by u.
static std::pair<Real, Real> at_parameter(ControlPoints p, Real u) {
  for (Eigen::Index left = 5; left > 1; --left)
    for (Eigen::Index i = 0; i < left; ++i) p[i] += u * (p[i + 1] - p[i]);
  const Real difference = p[1] - p[0];
  return {p[0] + u * difference, 5 * difference};
}

/// The u at which a piece has this x, by Newton's method within halved brackets: x grows with u.
static Real parameter_of(const ControlPoints& x, Real wanted) {
  Real low = 0, high = 1, u = std::clamp((wanted - x[0]) / (x[5] - x[0]), 0.0, 1.0);
  for (int i = 0; i < 60; ++i) {
    const auto [reached, speed] = at_parameter(x, u);
    if (std::abs(reached - wanted) < 1e-15 * (1 + std::abs(wanted))) break;
    (reached < wanted ? low : high) = u;
    const Real newton = speed > 0 ? u - (reached - wanted) / speed : -1;
    u = newton > low && newton < high ? newton : (low + high) / 2;
  }
  return u;
}

static Eigen::Index piece_at(const BezierCurve& curve, Real x) {
  Eigen::Index piece = 0;
  while (piece + 1 < curve.x.cols() && x > curve.x(5, piece)) ++piece;
  return piece;
}

Real value(const BezierCurve& curve, Real x) {
  const Eigen::Index last = curve.x.cols() - 1;
  if (x <= curve.x(0, 0)) return curve.y(0, 0) + (x - curve.x(0, 0)) * curve.first_slope;
  if (x >= curve.x(5, last)) return curve.y(5, last) + (x - curve.x(5, last)) * curve.last_slope;
  const Eigen::Index piece = piece_at(curve, x);
  return at_parameter(curve.y.col(piece), parameter_of(curve.x.col(piece), x)).first;
}

Real slope(const BezierCurve& curve, Real x) {
  if (x <= curve.x(0, 0)) return curve.first_slope;
  if (x >= curve.x(5, curve.x.cols() - 1)) return curve.last_slope;
  const Eigen::Index piece = piece_at(curve, x);
  const Real u = parameter_of(curve.x.col(piece), x);
  return at_parameter(curve.y.col(piece), u).second / at_parameter(curve.x.col(piece), u).second;
}

}  // namespace gracilis::opensim
