#include <gracilis/core/stop.hpp>

namespace gracilis {

static thread_local const std::atomic<bool>* watched = nullptr;

StopScope::StopScope(const std::atomic<bool>* flag) : outer_(watched) { watched = flag; }

StopScope::~StopScope() { watched = outer_; }

const std::atomic<bool>* stop_flag() { return watched; }

void throw_if_stopped() {
  if (watched && watched->load(std::memory_order_relaxed)) throw Interrupted();
}

}  // namespace gracilis
