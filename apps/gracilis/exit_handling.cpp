#include "exit_handling.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/core/failure.hpp>

#include <spdlog/spdlog.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
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

void ignore_size_signals() { std::signal(SIGXFSZ, SIG_IGN); }

/// What was printed is told to be written at the end only, and then nobody else would look.
static void require_printed() {
  const bool failed = std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout.flush();
  if (failed)
    throw InputError({"", "", std::string("the output cannot be written: ") + std::strerror(errno),
                      "check where stdout leads to and the free space there"});
}

int run_guarded(const std::function<int()>& command) {
  try {
    const int code = command();
    require_printed();
    return code;
  } catch (const std::exception&) {
    const Failure failure = current_failure();
    std::istringstream lines(failure.text);
    for (std::string line; std::getline(lines, line);) spdlog::error("{}", line);
    return static_cast<int>(failure.code);
  }
}

}  // namespace gracilis
