#include <gracilis/core/parallel.hpp>

#include <gracilis/core/first_failure.hpp>
#include <gracilis/core/stop.hpp>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

namespace gracilis {

void parallel_for(Index count, Index grain, const std::function<void(Index, Index)>& body) {
  throw_if_stopped();
  if (count <= 0) return;
  const Index chunks = (count + grain - 1) / grain;
  if (chunks == 1) return body(0, count);
  // One task per fixed chunk: the cuts are a property of the work, not of the machine.
  const std::atomic<bool>* const flag = stop_flag();
  FirstFailure failure;
  tbb::parallel_for(
      Index{0}, chunks,
      [&](Index chunk) {
        failure.run(chunk, [&] {
          const StopScope scope(flag);
          throw_if_stopped();
          body(chunk * grain, std::min(count, (chunk + 1) * grain));
        });
      },
      tbb::simple_partitioner());
  failure.rethrow();
}

ThreadLimit::ThreadLimit(int threads)
    : control_(threads <= 0 ? nullptr
                            : new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                                      static_cast<std::size_t>(threads))) {}

ThreadLimit::~ThreadLimit() { delete static_cast<tbb::global_control*>(control_); }

int thread_count() {
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

}  // namespace gracilis
