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
#include <utility>

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

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

using Clock = std::chrono::steady_clock;

double since(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }

/// A process that works.
struct Child {
  std::size_t number = 0;  ///< of its work
  pid_t process = 0;
  int report = -1;  ///< end of the pipe that it tells its end through; ends with it
  Clock::time_point began;
  std::string text;  ///< that came through the pipe
  bool was_stopped = false, timed_out = false;
};

Child begin_child(std::size_t number, const std::function<int()>& work, const ChildOptions& options) {
  int ends[2];
  const pid_t parent = ::getpid();
  std::fflush(nullptr);
  const auto refuse = [] {
    return Error(ExitCode::unreadable_input, std::string("the system gives no other process: ") + std::strerror(errno));
  };
  if (::pipe2(ends, O_CLOEXEC) != 0) throw refuse();
  Child child;
  child.number = number;
  child.report = ends[0];
  child.began = Clock::now();
  child.process = ::fork();
  if (child.process == 0) {
    ::close(ends[0]);
    be_child(work, options, ends[1], parent);
  }
  ::close(ends[1]);
  if (child.process < 0) {
    ::close(ends[0]);
    throw refuse();
  }
  return child;
}

/// Takes what came; true at the end of the pipe.
bool has_ended(Child& child) {
  char buffer[4096];
  const ssize_t size = ::read(child.report, buffer, sizeof buffer);
  if (size > 0) child.text.append(buffer, static_cast<std::size_t>(size));
  return size == 0 || (size < 0 && errno != EINTR);
}

ChildOutcome outcome_of(const Child& child, const ChildOptions& options) {
  ::close(child.report);
  int status = 0;
  rusage usage{};
  while (::wait4(child.process, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  ChildOutcome outcome;
  outcome.timed_out = child.timed_out;
  outcome.seconds = since(child.began);
  outcome.processor_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  outcome.peak_bytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
  const std::size_t line = child.text.find('\n');
  if (WIFEXITED(status) && line != std::string::npos) {
    outcome.code = std::atoi(child.text.c_str());
    outcome.reason = child.text.substr(line + 1);
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

/// Children at work, watched together.
class Watch {
 public:
  explicit Watch(const ChildOptions& options) : options_(options), called_(Clock::now()) {}
  ~Watch() {  // where a caller's function threw
    for (const Child& child : children_) ::kill(child.process, SIGKILL);
    for (const Child& child : children_) outcome_of(child, options_);
  }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  std::size_t size() const { return children_.size(); }
  void begin(std::size_t number, const std::function<int()>& work) {
    children_.push_back(begin_child(number, work, options_));
  }

  /// Waits until something happens; returns those that have ended.
  std::vector<Child> wait() {
    std::vector<pollfd> polled;
    double longest = options_.call_every - since(called_);
    for (const Child& child : children_) {
      polled.push_back({child.report, POLLIN, 0});
      if (options_.most_seconds > 0) longest = std::min(longest, options_.most_seconds - since(child.began));
    }
    const int ready =
        ::poll(polled.data(), polled.size(), static_cast<int>(1000 * std::clamp(longest, 0.0, 3600.0)) + 1);
    std::vector<Child> ended, going;
    for (std::size_t i = 0; i < children_.size(); ++i) {
      const bool is_over = ready > 0 && polled[i].revents != 0 && has_ended(children_[i]);
      (is_over ? ended : going).push_back(std::move(children_[i]));
    }
    children_ = std::move(going);
    for (Child& child : children_) end_where_due(child);
    if (since(called_) >= options_.call_every) {
      called_ = Clock::now();
      if (options_.call) options_.call();
    }
    return ended;
  }

 private:
  void end_where_due(Child& child) const {
    if (options_.is_asked_to_stop && options_.is_asked_to_stop() && !child.was_stopped) {
      child.was_stopped = true;
      ::kill(child.process, SIGTERM);
    }
    if (options_.most_seconds > 0 && since(child.began) >= options_.most_seconds && !child.timed_out) {
      child.timed_out = true;
      ::kill(child.process, SIGKILL);
    }
  }

  const ChildOptions& options_;
  Clock::time_point called_;
  std::vector<Child> children_;
};

}  // namespace

ChildOutcome run_in_child(const std::function<int()>& work, const ChildOptions& options) {
  return run_in_children({work}, 1, options).front();
}

std::vector<ChildOutcome> run_in_children(const std::vector<std::function<int()>>& works, int at_once,
                                          const ChildOptions& options,
                                          const std::function<void(std::size_t, const ChildOutcome&)>& ended) {
  ChildOutcome not_begun;
  not_begun.code = static_cast<int>(ExitCode::interrupted);
  std::vector<ChildOutcome> outcomes(works.size(), not_begun);
  Watch watch(options);
  std::size_t next = 0;
  for (;;) {
    const bool begins = !options.is_asked_to_stop || !options.is_asked_to_stop();
    for (; begins && next < works.size() && watch.size() < static_cast<std::size_t>(at_once); ++next)
      watch.begin(next, works[next]);
    if (watch.size() == 0) return outcomes;
    for (const Child& child : watch.wait()) {
      outcomes[child.number] = outcome_of(child, options);
      if (ended) ended(child.number, outcomes[child.number]);
    }
  }
}

}  // namespace gracilis
