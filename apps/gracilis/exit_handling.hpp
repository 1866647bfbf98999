#pragma once

#include <atomic>
#include <functional>

namespace gracilis {

/// Runs a command and turns what it throws into log lines and the exit code that the documentation promises: Error
/// knows its own, anything else is an internal error (1).
int run_guarded(const std::function<int()>& command);

/// True once the user has asked to stop (SIGINT or SIGTERM); watched from the first call on. The second signal ends
/// the program at once.
const std::atomic<bool>& stop_requested();

}  // namespace gracilis
