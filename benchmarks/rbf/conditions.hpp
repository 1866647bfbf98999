#pragma once

#include <gracilis/geometry/radial_kernel.hpp>

#include <vector>

/// Condition numbers of interpolation on the unit square by number of functions and shape parameter (Cervenka 2024,
/// section 5.7).
namespace gracilis {

/// What is put where.
struct ConditionMap {
  RadialShape shape = RadialShape::gaussian;
  bool is_grid = true;  ///< otherwise the Halton sequence
};

/// Decimal logarithm, in the 1-norm, of side² functions whose shape parameter is α = 10^log_alpha: Gaussians
/// exp(-α r²), or thin plates of r √α. Infinite where the matrix is singular.
Real log_condition(const ConditionMap& map, int side, Real log_alpha);

/// A shape parameter at which the matrix is singular.
struct ConditionPeak {
  Real log_alpha = 0;
  Real log_condition = 0;
};

/// Where the condition number rises at least thousandfold above that beside it: maxima among `looks` parameters from
/// `low` to `high`, each followed to its top.
std::vector<ConditionPeak> condition_peaks(const ConditionMap& map, int side, Real low, Real high, int looks);

}  // namespace gracilis
