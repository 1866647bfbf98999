#pragma once

#include <gracilis/geometry/field_path.hpp>

namespace gracilis {

/// A field's answer at one point in double precision.
struct PreciseSample {
  Real distance = std::numeric_limits<Real>::infinity();  ///< m; infinity outside of the grid
  Vec3 gradient = Vec3::Zero();
};

/// A smooth field's answer at one point.
struct CurvedSample {
  Real distance = std::numeric_limits<Real>::infinity();  ///< m; infinity outside of the grid
  Vec3 gradient = Vec3::Zero();
  Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();  ///< second derivatives, 1/m
};

/// Distance and gradient of the quadratic B-spline with the grid's values as coefficients (de Boor 1978), whose
/// gradient has no jumps at the borders of cells. It passes near the values, not through them: by h²/8 times the
/// surface's curvature off, h the size of a cell. In the outermost cells, where it lacks neighbors, the trilinear
/// interpolant.
FieldSample sample_spline(const FieldGrid& grid, const Eigen::Vector3f& p);

/// The same in double precision.
PreciseSample sample_spline_precise(const FieldGrid& grid, const Vec3& p);

/// The same, with second derivatives, piecewise constant along each axis; none in the outermost
/// cells.
CurvedSample sample_spline_curved(const FieldGrid& grid, const Vec3& p);

/// As sample_bounded: beyond the grid a lower bound and no gradient.
FieldSample sample_spline_bounded(const BoundedField& bounded, const Eigen::Vector3f& p);

}  // namespace gracilis
