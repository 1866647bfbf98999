#include "conditions.hpp"

#include <gracilis/geometry/radial_fit.hpp>
#include <gracilis/geometry/rbf_centers.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

Real log_condition(const ConditionMap& map, int side, Real log_alpha) {
  const Eigen::AlignedBox3d unit_square(Vec3::Zero(), Vec3(1, 1, 0));
  const Points points =
      map.is_grid ? grid_centers(unit_square, {side, side, 1}) : halton_centers(unit_square, side * side);
  return std::log10(
      interpolation_condition({{map.shape}, RadialPolynomial::none, 2}, points, std::pow(10, -log_alpha / 2)));
}

std::vector<ConditionPeak> condition_peaks(const ConditionMap& map, int side, Real low, Real high, int looks) {
  constexpr Real least_rise = 3;  // of the logarithm
  const Real step = (high - low) / (looks - 1);
  std::vector<Real> logs;
  for (int i = 0; i < looks; ++i) logs.push_back(log_condition(map, side, low + i * step));
  std::vector<ConditionPeak> peaks;
  for (std::size_t i = 1; i + 1 < logs.size(); ++i) {
    if (!(logs[i] > logs[i - 1] && logs[i] >= logs[i + 1])) continue;
    Real left = low + (static_cast<Real>(i) - 1) * step, right = left + 2 * step;
    while (right - left > 1e-9 * step) {
      const Real third = (right - left) / 3, a = left + third, b = right - third;
      if (log_condition(map, side, a) < log_condition(map, side, b))
        left = a;
      else
        right = b;
    }
    const ConditionPeak peak{(left + right) / 2, log_condition(map, side, (left + right) / 2)};
    if (peak.log_condition - std::max(logs[i - 1], logs[i + 1]) > least_rise) peaks.push_back(peak);
  }
  return peaks;
}

}  // namespace gracilis
