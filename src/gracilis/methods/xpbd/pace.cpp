#include <gracilis/methods/xpbd/pace.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis::xpbd {

/// Of the budget that is aimed at, and the steps in which the share falls and rises.
static constexpr Real aim = 0.85, largest_fall = 0.5, largest_rise = 1.1, smallest_share = 0.01;

int paced_iterations(const Pace& pace, int asked) {
  if (!(pace.budget > 0)) return asked;
  const int share = static_cast<int>(std::floor(pace.share * asked));
  return std::clamp(share, std::min(least_iterations, asked), asked);
}

void see_frame(Pace& pace, Real milliseconds) {
  if (!(pace.budget > 0 && milliseconds > 0)) return;
  const Real factor = std::clamp(aim * pace.budget / milliseconds, largest_fall, largest_rise);
  pace.share = std::clamp(pace.share * factor, smallest_share, Real{1});
}

}  // namespace gracilis::xpbd
