#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace gracilis {

/// What became of work that a process of its own did.
struct ChildOutcome {
  int code = 0;        ///< what the work returned, or the exit code of what it threw; 1 where the process died
  std::string reason;  ///< of what it threw, or the signal that ended it
  double seconds = 0, processor_seconds = 0;
  double peak_bytes = 0;  ///< most memory that it had at once
  bool timed_out = false;
};

struct ChildOptions {
  std::filesystem::path log;                    ///< takes what it writes to stdout and stderr, after what is in there
  double most_seconds = 0;                      ///< after which it is killed; 0: never
  double call_every = 10;                       ///< s
  std::function<void()> call = {};              ///< every so often while it works; may be empty
  std::function<bool()> is_asked_to_stop = {};  ///< then it is sent SIGTERM, once; looked at after signals, too
};

/// Forks, does the work there and waits for it. A process that crashes or takes all memory ends itself alone; one whose
/// parent is killed is killed, too. Precondition: this process runs one thread (TBB has not begun). Throws Error where
/// the system does not give another process.
ChildOutcome run_in_child(const std::function<int()>& work, const ChildOptions& options);

/// The same of several pieces of work, `at_once` at a time, begun in their order. `ended` is told of each as it ends,
/// in any order; may be empty. Once asked to stop, none begins any more: those left have the exit code `interrupted`.
std::vector<ChildOutcome> run_in_children(const std::vector<std::function<int()>>& works, int at_once,
                                          const ChildOptions& options,
                                          const std::function<void(std::size_t, const ChildOutcome&)>& ended = {});

}  // namespace gracilis
