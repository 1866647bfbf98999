#include <gracilis/prepare/time_limit.hpp>

#include <gracilis/core/stop.hpp>

#include <algorithm>
#include <ctime>
#include <limits>

namespace gracilis {

static Real processor_time() { return static_cast<Real>(std::clock()) / CLOCKS_PER_SEC; }

TimeLimit::TimeLimit(Real seconds)
    : limited_(seconds > 0),
      end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<Real>(seconds))),
      processor_end_(processor_time() + seconds) {}

Real TimeLimit::left() const {
  if (!limited_) return std::numeric_limits<Real>::infinity();
  // Several threads take more processor time than the clock says, one on a busy machine less.
  return std::max(std::chrono::duration<Real>(end_ - Clock::now()).count(), processor_end_ - processor_time());
}

void TimeLimit::check() const {
  throw_if_stopped();
  if (is_over()) throw OutOfTime();
}

}  // namespace gracilis
