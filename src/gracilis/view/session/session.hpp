#pragma once

#include <gracilis/core/errors.hpp>
#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/view/session/run_plan.hpp>
#include <gracilis/view/session/session_options.hpp>

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>

namespace gracilis {

enum class MessageKind { detail, note, warning };

/// Who is told how a session goes; what is empty is not called. Calls come one after the
/// other, but while frames are recorded beside the solver from another thread than the caller's.
struct SessionListener {
  std::string version;                      ///< of Gracilis, for the manifest
  const std::atomic<bool>* stop = nullptr;  ///< ends the session within a frame; null: nothing does
  std::function<void(MessageKind, const std::string&)> say = {};  ///< a line for people
  std::function<void(int first, int last)> begin = {};            ///< before the first frame is computed
  std::function<void(int done, int last)> progress = {};          ///< after each frame; may throw Interrupted

  /// Says it, where somebody listens.
  void tell(MessageKind kind, const std::string& text) const {
    if (say) say(kind, text);
  }
  /// What ends the session; never set where nothing does.
  const std::atomic<bool>& stop_or_never() const {
    static const std::atomic<bool> never{false};
    return stop ? *stop : never;
  }
};

struct SessionResult {
  ExitCode code = ExitCode::done;  ///< interrupted, with every frame so far on disk; quality under `strict`
  std::filesystem::path folder;
  std::string told = {};  ///< for programs (JSON): status, frames, seconds, gates, warnings, and what to look at
};

/// The options of a run that goes on are those that it began with.
SessionOptions as_begun(const LoadedScene& loaded, const SessionOptions& options);

/// Takes a scene through its whole motion into a run folder. Throws Error; QualityError where a value is not finite,
/// with the last good frame on disk. Preconditions: `options` are as_begun, `plan` is theirs.
SessionResult record_session(const LoadedScene& loaded, const SessionOptions& options, RunPlan plan,
                             const SessionListener& listener);

}  // namespace gracilis
