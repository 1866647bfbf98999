#include <gracilis/methods/xpbd/frame_budget.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gracilis::xpbd {

/// Of the budget that is aimed at, and the steps in which the share falls and rises.
static constexpr Real aim = 0.85, largest_fall = 0.5, largest_rise = 1.1, smallest_share = 0.01;

int budgeted_iterations(const FrameBudget& budget, int asked) {
  if (!(budget.budget > 0)) return asked;
  const int share = static_cast<int>(std::floor(budget.share * asked));
  return std::clamp(share, std::min(least_iterations, asked), asked);
}

void see_frame(FrameBudget& budget, Real milliseconds) {
  if (!(budget.budget > 0 && milliseconds > 0)) return;
  const Real factor = std::clamp(aim * budget.budget / milliseconds, largest_fall, largest_rise);
  budget.share = std::clamp(budget.share * factor, smallest_share, Real{1});
}

Metrics metrics_of(const FrameBudgetReport& frame) {
  return {{"target_fps", frame.target_fps},
          {"frame_milliseconds", frame.milliseconds},
          {"iterations", static_cast<Real>(frame.iterations)},
          {"asked_iterations", static_cast<Real>(frame.asked_iterations)},
          {"triangles", static_cast<Real>(frame.triangles)},
          {"asked_triangles", static_cast<Real>(frame.asked_triangles)}};
}

std::string remark_on(const std::vector<FrameBudgetReport>& frames) {
  if (frames.empty()) return {};
  std::vector<int> iterations;
  std::size_t in_time = 0;
  for (const FrameBudgetReport& frame : frames) {
    iterations.push_back(frame.iterations);
    if (frame.milliseconds * frame.target_fps <= 1000) ++in_time;
  }
  std::sort(iterations.begin(), iterations.end());
  const FrameBudgetReport& last = frames.back();
  std::ostringstream text;
  text << "target_fps = " << last.target_fps << ": " << in_time << " of " << frames.size() << " frames were in time; "
       << last.triangles << " of " << last.asked_triangles << " triangles were simulated, with " << iterations.front()
       << " to " << iterations.back() << " (median " << iterations[iterations.size() / 2] << ") of "
       << last.asked_iterations << " iterations; another machine gives other results";
  return text.str();
}

}  // namespace gracilis::xpbd
