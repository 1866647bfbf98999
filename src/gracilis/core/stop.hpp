#pragma once

#include <gracilis/core/errors.hpp>

#include <atomic>

namespace gracilis {

/// Thrown out of work that somebody asked to stop (exit code 130). What it was making is of no use.
class Interrupted : public Error {
 public:
  Interrupted() : Error(ExitCode::interrupted, "interrupted") {}
};

/// While it lives, this thread and the tasks that it starts by parallel_for throw Interrupted soon after `flag` is set:
/// where they start further tasks, and where they call throw_if_stopped(). A null flag stops nothing; the innermost
/// scope counts. The flag must outlive it.
class StopScope {
 public:
  /// Heeds the flag until the scope ends.
  explicit StopScope(const std::atomic<bool>* flag);
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

 private:
  const std::atomic<bool>* outer_;
};

/// The flag that this thread's work looks at; null where nothing stops it.
const std::atomic<bool>* stop_flag();

/// Throws Interrupted where this thread's work shall stop. For long work on one thread.
void throw_if_stopped();

}  // namespace gracilis
