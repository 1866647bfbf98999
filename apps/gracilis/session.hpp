#pragma once

#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/view/session/session_options.hpp>

#include <CLI/CLI.hpp>

namespace gracilis {

void add_session_options(CLI::App& command, SessionOptions& options);

/// Takes a scene through its whole motion into a run folder, with progress and warnings on stderr. Returns the
/// program's exit code: 0; 2 where it would take more room than is taken without being asked for; 130 when the user
/// stopped it, with every frame so far on disk; 5 under `strict` when a frame missed a quality gate. Throws Error.
int run_session(const LoadedScene& loaded, const SessionOptions& options);

}  // namespace gracilis
