#pragma once

#include <gracilis/anatomy/pose_sequence.hpp>
#include <gracilis/io/run/frame_times.hpp>
#include <gracilis/io/run/run_size.hpp>
#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/view/session/session_options.hpp>

#include <optional>
#include <string>
#include <vector>

namespace gracilis {

/// Which frames of a scene a run records, and what they take.
struct RunPlan {
  SequenceParts parts;
  std::vector<int> recorded;   ///< poses of the sequence; empty: all
  int frames = 0;              ///< that are recorded
  int first_motion_frame = 0;  ///< of those recorded
  RunLayout layout = RunLayout::surfaces;
  RunSize size;
  std::optional<double> seconds;  ///< by what runs before took; nothing where there was none
};

/// What of a run tells how long its frames take.
FrameCost frame_cost(const LoadedScene& loaded, const SessionOptions& options);

/// Throws ConfigurationError where the scene asks for more frames than it allows.
RunPlan plan_run(const LoadedScene& loaded, const SessionOptions& options);

/// How many frames of what there are, and what they take, as in "151 frames: 51 from the capture pose to the motion,
/// 100 of the motion; about 1.1 GB in 30,653 files, in about 9 min".
std::string describe_plan(const RunPlan& plan);

/// Beyond this a run asks, or wants to be told beforehand.
inline constexpr double asking_bytes = 2e9;

/// Of a run that would have more files, or more bytes than that, a file holds a whole frame: copying and listing so
/// many takes longer than computing them does.
inline constexpr std::int64_t most_surface_files = 20'000;

/// As in "1.1 GB in 30,653 files", and the time where it is known and worth a word: ", in about 9 min".
std::string cost_text(const RunPlan& plan);

}  // namespace gracilis
