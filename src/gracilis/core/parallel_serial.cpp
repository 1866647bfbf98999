// Stands in for parallel.cpp where there are no threads (WebAssembly): the same cuts, one after the other, so the same
// bits.
#include <gracilis/core/parallel.hpp>

namespace gracilis {

void parallel_for(Index count, Index grain, const std::function<void(Index, Index)>& body) {
  for (Index begin = 0; begin < count; begin += grain) body(begin, std::min(count, begin + grain));
}

ThreadLimit::ThreadLimit(int /*threads*/) : control_(nullptr) {}
ThreadLimit::~ThreadLimit() = default;

int thread_count() { return 1; }

}  // namespace gracilis
