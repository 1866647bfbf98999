#pragma once

#include <gracilis/core/types.hpp>

#include <atomic>
#include <exception>
#include <limits>
#include <mutex>

namespace gracilis {

/// Of the parts of one piece of work, the first in their order that failed, whatever threads they ran on and when.
class FirstFailure {
 public:
  /// Whether a part that comes before this one has failed, so that nobody would hear of this one.
  bool comes_before(Index part) const { return first_.load(std::memory_order_relaxed) < part; }

  /// Runs a part, unless it no longer matters, and keeps what it throws.
  template <class Act>
  void run(Index part, const Act& act) {
    if (comes_before(part)) return;
    try {
      act();
    } catch (...) {
      const std::lock_guard lock(keeping_);
      if (comes_before(part)) return;
      first_.store(part, std::memory_order_relaxed);
      failure_ = std::current_exception();
    }
  }

  /// Throws what the first one threw. To be called when all have ended.
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::atomic<Index> first_ = std::numeric_limits<Index>::max();
  std::mutex keeping_;
  std::exception_ptr failure_;
};

}  // namespace gracilis
