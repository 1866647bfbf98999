#pragma once

#include <atomic>
#include <functional>

namespace gracilis {

/// A file that outgrows its limit or the disk is a failed write with a message, not the end of the program.
void ignore_size_signals();

/// Opens /dev/null where stdin, stdout or stderr is closed: the next file would get its number, and the log would be
/// written into it. Writing to such a stdout fails as before.
void open_closed_streams();

/// Runs a command and turns what it throws into log lines and the exit code that the documentation promises: Error
/// knows its own, what the system refuses (as a path that cannot be looked at, or printing to a full disk) is 3,
/// anything else is an internal error (1). Of many lines the first are logged, and how many more there were.
int run_guarded(const std::function<int()>& command);

/// True once the user has asked to stop (SIGINT or SIGTERM); watched from the first call on. The second signal ends
/// the program at once.
const std::atomic<bool>& stop_requested();

}  // namespace gracilis
