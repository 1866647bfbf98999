#include "exit_handling.hpp"

#include <gracilis/core/errors.hpp>

#include <spdlog/spdlog.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <new>
#include <sstream>
#include <system_error>

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
  } catch (const Error& error) {
    std::istringstream lines(error.what());
    for (std::string line; std::getline(lines, line);) spdlog::error("{}", line);
    return static_cast<int>(error.code());
  } catch (const std::filesystem::filesystem_error& error) {
    spdlog::error("{}: {}", error.path1().string(), error.code().message());
    return static_cast<int>(ExitCode::unreadable_input);
  } catch (const std::system_error& error) {
    spdlog::error("the system refused: {}", error.what());
    return static_cast<int>(ExitCode::unreadable_input);
  } catch (const std::bad_alloc&) {
    spdlog::error("out of memory");
  } catch (const std::exception& error) {
    spdlog::error("internal error: {}", error.what());
  }
  return static_cast<int>(ExitCode::internal);
}

}  // namespace gracilis
