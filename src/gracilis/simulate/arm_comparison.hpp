#pragma once

#include <gracilis/core/types.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// Moment arms of one muscle about one coordinate as somebody else measured or computed them.
struct ArmCurve {
  std::string muscle, coordinate, source;  ///< empty: unknown
  std::vector<Real> angles = {};           ///< rad, ascending
  std::vector<Real> arms = {};             ///< m, -dL/dq
  std::vector<Real> low = {}, high = {};   ///< m, of what the arms are the mean of, per angle; empty: unknown
};

/// How moment arms lie beside a reference, over the angles that both have.
struct ArmComparison {
  Index angles = 0;          ///< compared: none where the ranges have nothing in common
  Real from = 0, to = 0;     ///< rad, of these
  Real rms = 0;              ///< m, of the differences from the reference
  Real largest = 0;          ///< m, of the differences
  Real slope = 0;            ///< m/rad, of a line through the arms near 0; NaN without two angles there
  Real reference_slope = 0;  ///< the same of the reference at these angles
};

/// Compares arms (m) at `angles` (rad, ascending or descending) with a curve, which is linear between its angles.
/// "Near 0" is within 10 degrees.
ArmComparison compare_arms(const std::vector<Real>& angles, const std::vector<Real>& arms, const ArmCurve& reference);

/// The mean distance of arms (m) from the band that all curves span together, from the least to the largest of their
/// arms, or of `low` and `high` where they have these: 0 inside. Over the angles that all curves have; NaN where there
/// are none.
Real mean_distance_from_band(const std::vector<Real>& angles, const std::vector<Real>& arms,
                             const std::vector<ArmCurve>& curves);

}  // namespace gracilis
