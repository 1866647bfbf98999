#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// What a run folder is worth.
struct Verification {
  std::string status;                 ///< complete, interrupted, ... as run.json says
  int frames = 0;                     ///< that are whole
  std::size_t files = 0;              ///< whose hashes were compared; 0 where the run has no list of them
  std::vector<std::string> findings;  ///< what is missing, changed or inconsistent, a sentence each
};

/// Compares every file of a run with its hash from when the run ended, and what the folder says with what lies in it:
/// frames with run.json, vertices with frame 0, the measured volumes with those of the surfaces, and the lengths of
/// fibers with those of their lines. Throws InputError where there is no run, or one that cannot be read at all.
Verification verify_run(const std::filesystem::path& folder);

}  // namespace gracilis
