#include <gracilis/view/window/slider_range.hpp>

#include <algorithm>

namespace gracilis {

std::pair<Real, Real> slider_range(const JointAxis& axis) {
  const Real most = axis.translation ? 0.1 : radians(120);
  return {std::min(std::max(axis.range_min, -most), axis.capture_value),
          std::max(std::min(axis.range_max, most), axis.capture_value)};
}

}  // namespace gracilis
