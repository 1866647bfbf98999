#include <gracilis/prepare/time_limit.hpp>

#include <gracilis/core/stop.hpp>

#include <limits>

namespace gracilis {

TimeLimit::TimeLimit(Real seconds)
    : limited_(seconds > 0),
      end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<Real>(seconds))) {}

Real TimeLimit::left() const {
  if (!limited_) return std::numeric_limits<Real>::infinity();
  return std::chrono::duration<Real>(end_ - Clock::now()).count();
}

void TimeLimit::check() const {
  throw_if_stopped();
  if (is_over()) throw OutOfTime();
}

}  // namespace gracilis
