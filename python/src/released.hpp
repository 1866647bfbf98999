#pragma once

#include <gracilis/core/stop.hpp>

#include <pybind11/pybind11.h>

#include <atomic>
#include <csignal>

namespace gracilis::python {

/// While it lives on Python's main thread, Ctrl-C also sets `flag`, so that work without the interpreter ends within
/// a frame; Python's own handler still hears of it. On other threads it does nothing: signals are not theirs.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  /// Null where nothing is watched.
  const std::atomic<bool>* flag() const;

 private:
  bool watching_ = false;
  struct sigaction before_ = {};
};

/// Ends the call with KeyboardInterrupt, or with what Python's handler of the signal raises.
[[noreturn]] void raise_interrupt();

/// Does work that needs no interpreter while other Python threads go on. Call it with the interpreter's lock held.
template <class Work>
auto released(const Work& work) {
  const InterruptWatch watch;
  try {
    const pybind11::gil_scoped_release release;
    const StopScope scope(watch.flag());
    return work();
  } catch (const Interrupted&) {
  }
  raise_interrupt();
}

}  // namespace gracilis::python
