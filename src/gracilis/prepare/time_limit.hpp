#pragma once

#include <gracilis/core/errors.hpp>
#include <gracilis/core/types.hpp>

#include <chrono>

namespace gracilis {

/// Thrown out of work that took longer than it may.
class OutOfTime : public Error {
 public:
  OutOfTime() : Error(ExitCode::unreadable_input, "out of time") {}
};

/// How long work may take from now on. Long work asks now and then. Time counts while this process has a processor, so
/// that a busy machine refuses nothing that an idle one does.
class TimeLimit {
 public:
  /// Without seconds there is no limit.
  explicit TimeLimit(Real seconds = 0);

  bool is_over() const { return left() <= 0; }
  /// s; infinite without a limit.
  Real left() const;
  /// Throws OutOfTime when it is over, and Interrupted where somebody stops this thread's work.
  void check() const;

 private:
  using Clock = std::chrono::steady_clock;
  bool limited_;
  Clock::time_point end_;
  Real processor_end_;  ///< s of this process, of all its threads
};

}  // namespace gracilis
