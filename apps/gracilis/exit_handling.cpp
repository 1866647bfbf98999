#include "exit_handling.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/core/failure.hpp>

#include <spdlog/spdlog.h>

#include <fcntl.h>

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

void open_closed_streams() {
  for (const int stream : {0, 1, 2}) {
    if (fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
    const int opened = open("/dev/null", stream == 2 ? O_WRONLY : O_RDONLY);  // gets the lowest number that is free
    (void)opened;
  }
}

/// Logs a problem per line. A broken file may have tens of thousands, and a name in it any length.
static void log_problems(const std::string& text) {
  constexpr int most_lines = 20;
  constexpr std::size_t longest_line = 4000;
  std::istringstream lines(text);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    if (count >= most_lines) continue;
    if (line.size() > longest_line) line = line.substr(0, longest_line) + " ...";
    spdlog::error("{}", line);
  }
  if (count > most_lines) spdlog::error("and {} more", count - most_lines);
}

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
    log_problems(failure.text);
    return static_cast<int>(failure.code);
  }
}

}  // namespace gracilis
