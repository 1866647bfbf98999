#pragma once

#include <gracilis/view/session/session.hpp>

namespace gracilis {

/// Takes a scene through its whole motion and leaves of it what tables say of its fibers: fiber_lengths.sto and, where
/// the method knows them, moment_arms_<coordinate>.sto (action_tables.hpp), one row a frame. No surfaces, measures or
/// manifest: what is left is no run. Tables appear when all is done, and each whole; an interrupted session leaves
/// none. Throws ConfigurationError where a run is in the folder, or tables are and `force` is not given, and Error as
/// record_session does. Precondition: `options.out` is not empty.
SessionResult record_tables(const LoadedScene& loaded, const SessionOptions& options, const SessionListener& listener);

}  // namespace gracilis
