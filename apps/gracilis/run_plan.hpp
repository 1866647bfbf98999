#pragma once

#include "session.hpp"

#include <gracilis/anatomy/pose_sequence.hpp>
#include <gracilis/io/run/run_size.hpp>

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
};

/// Throws ConfigurationError where the scene asks for more frames than it allows.
RunPlan plan_run(const LoadedScene& loaded, const SessionOptions& options);

/// How many frames of what there are, and what they take, as in "151 frames: 51 from the capture pose to the motion,
/// 100 of the motion; about 1.1 GB in 30,653 files".
std::string describe_plan(const RunPlan& plan);

/// Beyond this a run asks, or wants to be told beforehand.
inline constexpr double asking_bytes = 2e9;

/// Asks on a terminal whether a run that takes more than `asking_bytes` shall begin. Throws Error (exit code 2) where
/// the answer is no, or where there is no terminal to ask and `yes` was not given; its text has the ways out.
void confirm_size(const RunPlan& plan, const SessionOptions& options);

}  // namespace gracilis
