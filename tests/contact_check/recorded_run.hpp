#pragma once

#include "judge.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis::contact_check {

/// A run folder, seen from outside: names and files only.
struct RecordedRun {
  std::filesystem::path folder;
  std::vector<std::string> muscles, bones;
  int frame_count = 0;  ///< frames 0 ... frame_count - 1 are there for every surface
};

/// Muscles are those that measures.csv names, bones all other surfaces of frame 0. Throws InputError.
RecordedRun open_run(const std::filesystem::path& folder);

/// Points of every surface of a frame, m, in the order of `names`.
std::vector<Points> read_points(const RecordedRun& run, const std::vector<std::string>& names, int frame);

/// The judge of a run: rest is frame 0. A vertex counts as attached when it moves rigidly with one and the same bone
/// through frames spread over the run (to 2 µm, what single precision leaves).
Judge judge_of(const RecordedRun& run);

/// Which points move rigidly with a bone from their place at rest.
std::vector<char> moves_with(const Points& bone_rest, const Points& bone_now, const Points& rest, const Points& now);

}  // namespace gracilis::contact_check
