#include <gracilis/study/child_process.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/failure.hpp>

#include <fmt/format.h>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace gracilis {

namespace {

/// What a pipe takes at once, so that the child never waits for somebody to read it.
constexpr std::size_t most_reason = 3000;

struct WorkEnd {
  int code = 1;
  std::string reason;
};

WorkEnd guarded(const std::function<int()>& work) {
  try {
    return {work(), ""};
  } catch (const std::exception&) {
    const Failure failure = current_failure();
    return {static_cast<int>(failure.code), failure.text};
  }
}

void write_to_log(const std::filesystem::path& log) {
  const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file < 0) return;
  ::dup2(file, STDOUT_FILENO);
  ::dup2(file, STDERR_FILENO);
}

[[noreturn]] void be_child(const std::function<int()>& work, const ChildOptions& options, int report, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it died before this one asked
  if (!options.log.empty()) write_to_log(options.log);
  WorkEnd end = guarded(work);
  if (!end.reason.empty()) std::fprintf(stderr, "error: %s\n", end.reason.c_str());
  std::fflush(nullptr);
  end.reason.resize(std::min(end.reason.size(), most_reason));
  const std::string text = std::to_string(end.code) + "\n" + end.reason;
  const bool told = ::write(report, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  ::_exit(told ? 0 : 1);  // nothing that belongs to the parent is to be taken down here
}

/// Waits for the end of the pipe, which is that of the child, and returns what came.
std::string watch(pid_t child, int report, const ChildOptions& options, ChildOutcome& outcome) {
  using Clock = std::chrono::steady_clock;
  const auto began = Clock::now();
  const auto since = [](Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); };
  auto called = began;
  bool was_stopped = false;
  std::string text;
  for (;;) {
    double wait = options.call_every - since(called);
    if (options.most_seconds > 0) wait = std::min(wait, options.most_seconds - since(began));
    pollfd polled{report, POLLIN, 0};
    const int ready = ::poll(&polled, 1, static_cast<int>(1000 * std::clamp(wait, 0.0, 3600.0)) + 1);
    if (ready > 0) {
      char buffer[4096];
      const ssize_t size = ::read(report, buffer, sizeof buffer);
      if (size == 0 || (size < 0 && errno != EINTR)) return text;
      if (size > 0) text.append(buffer, static_cast<std::size_t>(size));
    }
    if (options.is_asked_to_stop && options.is_asked_to_stop() && !was_stopped) {
      was_stopped = true;
      ::kill(child, SIGTERM);
    }
    if (options.most_seconds > 0 && since(began) >= options.most_seconds && !outcome.timed_out) {
      outcome.timed_out = true;
      ::kill(child, SIGKILL);
    }
    if (since(called) < options.call_every) continue;
    called = Clock::now();
    if (options.call) options.call();
  }
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

ChildOutcome run_in_child(const std::function<int()>& work, const ChildOptions& options) {
  int ends[2];
  const pid_t parent = ::getpid();
  std::fflush(nullptr);
  const auto refuse = [] {
    return Error(ExitCode::unreadable_input, std::string("the system gives no other process: ") + std::strerror(errno));
  };
  if (::pipe2(ends, O_CLOEXEC) != 0) throw refuse();
  const auto began = std::chrono::steady_clock::now();
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    be_child(work, options, ends[1], parent);
  }
  ::close(ends[1]);
  ChildOutcome outcome;
  if (child < 0) {
    ::close(ends[0]);
    throw refuse();
  }
  const std::string text = watch(child, ends[0], options, outcome);
  ::close(ends[0]);
  int status = 0;
  rusage usage{};
  while (::wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  outcome.processor_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  outcome.peak_bytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
  const std::size_t line = text.find('\n');
  if (WIFEXITED(status) && line != std::string::npos) {
    outcome.code = std::atoi(text.c_str());
    outcome.reason = text.substr(line + 1);
  } else {
    outcome.code = static_cast<int>(ExitCode::internal);
    outcome.reason =
        outcome.timed_out ? fmt::format("took longer than {:g} s", options.most_seconds)
        : WIFSIGNALED(status)
            ? fmt::format("the process was ended by signal {} ({}){}", WTERMSIG(status), strsignal(WTERMSIG(status)),
                          WTERMSIG(status) == SIGKILL ? ", as where memory runs out" : "")
            : std::string("the process ended by itself");
  }
  return outcome;
}

}  // namespace gracilis
