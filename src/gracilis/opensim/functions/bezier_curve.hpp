#pragma once

#include <gracilis/core/types.hpp>

namespace gracilis::opensim {

/// A smooth curve y(x) of Bézier pieces of fifth degree, each rounding the corner between two lines, straight beyond
/// its ends (Millard et al. 2013; OpenSim's SmoothSegmentedFunction).
struct BezierCurve {
  Eigen::Matrix<Real, 6, Eigen::Dynamic> x, y;  ///< control points, a column per piece; x increases
  Real first_slope = 0, last_slope = 0;
};

/// A point of a curve and its slope there.
struct CurveEnd {
  Real x = 0, y = 0, slope = 0;
};

/// Adds the piece between two points: from one along its slope, then along the other's. `curviness` from 0 to 1 says
/// how near it comes to where these lines meet. A curve's first piece begins it, others begin where the last one ended.
void add_corner(BezierCurve& curve, const CurveEnd& from, const CurveEnd& to, Real curviness);

/// The curve at x; beyond its ends it goes on straight.
Real value(const BezierCurve& curve, Real x);
/// Its derivative there.
Real slope(const BezierCurve& curve, Real x);

}  // namespace gracilis::opensim
