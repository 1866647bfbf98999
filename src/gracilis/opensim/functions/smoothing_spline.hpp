#pragma once

#include <gracilis/opensim/functions/function.hpp>

namespace gracilis::opensim {

/// OpenSim's GCVSpline (Woltring 1986).
struct SmoothingSplineSettings {
  int half_order = 2;         ///< m, 1 to 4: pieces of degree 2 m - 1, m = 2 is cubic
  std::vector<Real> weights;  ///< one per point, positive; none: all 1
  Real error_variance = 0;    ///< of the values; 0: through the points; negative: not known
};

/// Of all functions the natural spline f of degree 2 m - 1 that makes Σ w (y - f(x))² + p ∫ (f⁽ᵐ⁾)² least; beyond the
/// ends a polynomial of degree m - 1. p is 0 where the values are exact. Where their variance is known, it is the p for
/// which the expected error of prediction is least; where it is not, generalized cross-validation chooses (Craven and
/// Wahba 1979). At most 1000 points, 2 m of them at least, x increasing.
Function smoothing_spline(const std::vector<Real>& x, const std::vector<Real>& y,
                          const SmoothingSplineSettings& settings);

}  // namespace gracilis::opensim
