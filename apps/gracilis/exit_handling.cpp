#include "exit_handling.hpp"

#include <gracilis/core/errors.hpp>

#include <spdlog/spdlog.h>

#include <csignal>
#include <new>
#include <sstream>

namespace gracilis {

static std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "signal handlers may touch lock-free atomics only");

extern "C" void request_stop(int signal) {
  stop = true;
  std::signal(signal, SIG_DFL);
}

const std::atomic<bool>& stop_requested() {
  static const bool watching = [] {
    std::signal(SIGINT, request_stop);
    std::signal(SIGTERM, request_stop);
    return true;
  }();
  (void)watching;
  return stop;
}

int run_guarded(const std::function<int()>& command) {
  try {
    return command();
  } catch (const Error& error) {
    std::istringstream lines(error.what());
    for (std::string line; std::getline(lines, line);) spdlog::error("{}", line);
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    spdlog::error("out of memory");
  } catch (const std::exception& error) {
    spdlog::error("internal error: {}", error.what());
  }
  return static_cast<int>(ExitCode::internal);
}

}  // namespace gracilis
