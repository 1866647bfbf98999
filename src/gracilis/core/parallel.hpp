#pragma once

#include <gracilis/core/types.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace gracilis {

/// Calls body(begin, end) on disjoint ranges that cover [0, count), possibly at the same time. How the work is cut
/// never depends on the number of threads, so a body that writes only to its own range gives the same bits with any
/// number. `grain` is the size of a range; a count up to `grain` runs on the calling thread. Where bodies throw, the
/// caller gets what the first of the failing ranges threw, also with any number of threads; later ones may be left out.
void parallel_for(Index count, Index grain, const std::function<void(Index begin, Index end)>& body);

/// Calls act(i) for every number below `count`, each a task of its own: for a few pieces of work of different size.
template <class Act>
void parallel_for_each(std::size_t count, const Act& act) {
  parallel_for(static_cast<Index>(count), 1, [&](Index begin, Index end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) act(i);
  });
}

/// What body(begin, end, part) appends to its part, for disjoint ranges that cover [0, count), in the order of ranges.
template <class Item, class Body>
std::vector<Item> collect_in_order(Index count, Index grain, const Body& body) {
  std::vector<std::vector<Item>> parts(static_cast<std::size_t>((std::max(count, Index{0}) + grain - 1) / grain));
  parallel_for(count, grain, [&](Index begin, Index end) {
    for (Index from = begin; from < end; from += grain)
      body(from, std::min(from + grain, end), parts[static_cast<std::size_t>(from / grain)]);
  });
  std::vector<Item> items;
  for (const std::vector<Item>& part : parts) items.insert(items.end(), part.begin(), part.end());
  return items;
}

/// Caps the threads that parallel_for uses while it lives. 0 means all of the machine's.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);  ///< 0 takes all of the machine
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_;
};

/// How many threads parallel_for may use at this moment.
int thread_count();

}  // namespace gracilis
