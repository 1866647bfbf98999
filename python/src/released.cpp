#include "released.hpp"

namespace py = pybind11;

namespace gracilis::python {

static std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "signal handlers may touch lock-free atomics only");
static void (*handler_before)(int) = nullptr;

static void hear_interrupt(int signal) {
  interrupted = true;
  handler_before(signal);
}

static bool is_main_thread() {
  const py::module_ threading = py::module_::import("threading");
  return threading.attr("main_thread")().attr("ident").cast<unsigned long>() == PyThread_get_thread_ident();
}

InterruptWatch::InterruptWatch() {
  if (!is_main_thread() || sigaction(SIGINT, nullptr, &before_) != 0) return;
  const bool is_ours = before_.sa_handler == hear_interrupt;  // a call within a call, as from a callback
  const bool is_plain =
      !(before_.sa_flags & SA_SIGINFO) && before_.sa_handler != SIG_DFL && before_.sa_handler != SIG_IGN;
  if (is_ours || !is_plain) return;
  interrupted = false;
  handler_before = before_.sa_handler;
  struct sigaction now = before_;
  now.sa_handler = hear_interrupt;
  watching_ = sigaction(SIGINT, &now, nullptr) == 0;
}

InterruptWatch::~InterruptWatch() {
  if (watching_) sigaction(SIGINT, &before_, nullptr);
}

const std::atomic<bool>* InterruptWatch::flag() const { return watching_ ? &interrupted : nullptr; }

void raise_interrupt() {
  if (PyErr_CheckSignals() == 0) PyErr_SetNone(PyExc_KeyboardInterrupt);
  throw py::error_already_set();
}

}  // namespace gracilis::python
