#include <gracilis/geometry/hermite_curve.hpp>

#include <algorithm>

namespace gracilis {

Real value_at(const HermiteCurve& curve, Real x) {
  if (curve.knots.empty()) return 0;
  const auto after =
      static_cast<std::size_t>(std::upper_bound(curve.knots.begin(), curve.knots.end(), x) - curve.knots.begin());
  if (after == 0 || after == curve.knots.size()) {
    const std::size_t end = after == 0 ? 0 : after - 1;
    return curve.values[end] + curve.slopes[end] * (x - curve.knots[end]);
  }
  const std::size_t left = after - 1;
  const Real width = curve.knots[after] - curve.knots[left], t = (x - curve.knots[left]) / width;
  const Real rise = curve.values[after] - curve.values[left];
  const Real a = width * curve.slopes[left] - rise, b = rise - width * curve.slopes[after];
  return curve.values[left] + t * rise + t * (1 - t) * ((1 - t) * a + t * b);
}

}  // namespace gracilis
