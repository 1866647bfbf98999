// Stands in for parallel.cpp under the thread sanitizer, which does not see how TBB's threads wait for each other: the
// same cuts by threads that live as long as the call, so that it sees every race of a body with itself.
#include <gracilis/core/parallel.hpp>

#include <gracilis/core/first_failure.hpp>
#include <gracilis/core/stop.hpp>

#include <atomic>
#include <cstdint>
#include <thread>
#include <utility>

namespace gracilis {

namespace {

std::atomic<int> thread_limit = 4;
thread_local bool is_inside = false;  // of a call: what it calls itself runs on its own thread

}  // namespace

void parallel_for(Index count, Index grain, const std::function<void(Index, Index)>& body) {
  throw_if_stopped();
  if (count <= 0) return;
  const Index chunks = (count + grain - 1) / grain;
  if (chunks == 1) return body(0, count);
  const std::atomic<bool>* const flag = stop_flag();
  std::atomic<Index> next = 0;
  FirstFailure failure;
  const auto work = [&] {
    const StopScope scope(flag);
    const bool was_inside = std::exchange(is_inside, true);
    // Relaxed: otherwise a chunk would seem to wait for those before it.
    for (Index chunk = next.fetch_add(1, std::memory_order_relaxed); chunk < chunks;
         chunk = next.fetch_add(1, std::memory_order_relaxed))
      failure.run(chunk, [&] {
        throw_if_stopped();
        body(chunk * grain, std::min(count, (chunk + 1) * grain));
      });
    is_inside = was_inside;
  };
  std::vector<std::thread> others;
  for (int i = 1; !is_inside && i < std::min(chunks, static_cast<Index>(thread_count())); ++i)
    others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
  failure.rethrow();
}

ThreadLimit::ThreadLimit(int threads) : control_(nullptr) {
  const int before = thread_limit;
  control_ = reinterpret_cast<void*>(static_cast<std::intptr_t>(before));
  if (threads > 0) thread_limit = std::min(before, threads);
}

ThreadLimit::~ThreadLimit() { thread_limit = static_cast<int>(reinterpret_cast<std::intptr_t>(control_)); }

int thread_count() { return thread_limit; }

}  // namespace gracilis
