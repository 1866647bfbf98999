#include <gracilis/simulate/arm_comparison.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis {

namespace {

constexpr Real near_zero = radians(10);
/// Angles that are told in degrees with few digits still belong to the range.
constexpr Real angle_rounding = 1e-9;

bool has(const ArmCurve& curve, Real angle) {
  return !curve.angles.empty() && angle > curve.angles.front() - angle_rounding &&
         angle < curve.angles.back() + angle_rounding;
}

/// Linear between the angles. Precondition: the angle lies between the first and the last.
Real value_at(const ArmCurve& curve, const std::vector<Real>& values, Real angle) {
  const auto after = std::upper_bound(curve.angles.begin(), curve.angles.end(), angle);
  const auto next = static_cast<std::size_t>(after - curve.angles.begin());
  if (next == 0) return values.front();
  if (next == values.size()) return values.back();
  const Real share = (angle - curve.angles[next - 1]) / (curve.angles[next] - curve.angles[next - 1]);
  return values[next - 1] + share * (values[next] - values[next - 1]);
}

/// Of the least-squares line; NaN without two different angles.
Real slope_of(const std::vector<Real>& x, const std::vector<Real>& y) {
  Real mean_x = 0, mean_y = 0, products = 0, squares = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    mean_x += x[i] / static_cast<Real>(x.size()), mean_y += y[i] / static_cast<Real>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    products += (x[i] - mean_x) * (y[i] - mean_y), squares += (x[i] - mean_x) * (x[i] - mean_x);
  return squares > 0 ? products / squares : std::numeric_limits<Real>::quiet_NaN();
}

}  // namespace

ArmComparison compare_arms(const std::vector<Real>& angles, const std::vector<Real>& arms, const ArmCurve& reference) {
  ArmComparison comparison;
  std::vector<Real> near_angles, near_arms, near_reference;
  Real squares = 0;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (!has(reference, angles[i])) continue;
    const Real expected = value_at(reference, reference.arms, angles[i]), difference = arms[i] - expected;
    comparison.from = comparison.angles == 0 ? angles[i] : std::min(comparison.from, angles[i]);
    comparison.to = comparison.angles == 0 ? angles[i] : std::max(comparison.to, angles[i]);
    ++comparison.angles;
    squares += difference * difference;
    comparison.largest = std::max(comparison.largest, std::abs(difference));
    if (std::abs(angles[i]) > near_zero) continue;
    near_angles.push_back(angles[i]), near_arms.push_back(arms[i]), near_reference.push_back(expected);
  }
  if (comparison.angles > 0) comparison.rms = std::sqrt(squares / static_cast<Real>(comparison.angles));
  comparison.slope = slope_of(near_angles, near_arms);
  comparison.reference_slope = slope_of(near_angles, near_reference);
  return comparison;
}

Real mean_distance_from_band(const std::vector<Real>& angles, const std::vector<Real>& arms,
                             const std::vector<ArmCurve>& curves) {
  Real sum = 0;
  Index count = 0;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    Real low = std::numeric_limits<Real>::infinity(), high = -low;
    const bool all_have_it = std::all_of(curves.begin(), curves.end(), [&](const ArmCurve& curve) {
      if (!has(curve, angles[i])) return false;
      low = std::min(low, value_at(curve, curve.low.empty() ? curve.arms : curve.low, angles[i]));
      high = std::max(high, value_at(curve, curve.high.empty() ? curve.arms : curve.high, angles[i]));
      return true;
    });
    if (!all_have_it || curves.empty()) continue;
    sum += std::max({low - arms[i], arms[i] - high, Real{0}});
    ++count;
  }
  return count > 0 ? sum / static_cast<Real>(count) : std::numeric_limits<Real>::quiet_NaN();
}

}  // namespace gracilis
