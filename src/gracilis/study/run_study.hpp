#pragma once

#include <gracilis/study/child_process.hpp>
#include <gracilis/study/run_record.hpp>

#include <functional>
#include <string>
#include <vector>

namespace gracilis {

/// Every so many runs of a study, the first being `number` (1 ... count).
struct Shard {
  Index number = 1, count = 1;
};

/// Does a run into a folder, as `gracilis run --out` does; `resume`: goes on with what is there. Returns the exit code
/// or throws. Called in a process of its own.
using RunFunction = std::function<int(const StudyRun& run, const std::filesystem::path& folder, bool resume)>;

struct StudyRunOptions {
  std::string version;
  Shard shard;
  std::vector<std::string> names;               ///< of runs to do; empty: all of the shard
  bool retry = false;                           ///< also what has failed for good
  std::function<bool()> is_asked_to_stop;       ///< may be empty
  std::function<void(const std::string&)> say;  ///< a line for every run; may be empty
};

/// What became of the runs that were asked for.
struct StudyEnd {
  int complete_before = 0;  ///< or done by other processes meanwhile
  int done = 0, failed = 0;
  bool interrupted = false;
};

/// Does what is not complete of a shard, one run after the other: each is claimed (run_claim.hpp), made aside and
/// renamed; one that fails leaves its reason (run_record.hpp), and the next begins. Any number of processes on any
/// machines may do so at once in the same folder; what others work on is waited for. Throws InputError where the folder
/// cannot be written.
StudyEnd run_study(const Study& study, const RunFunction& run, const StudyRunOptions& options);

/// The runs of a shard, or those of these names. Throws ConfigurationError where one is not there.
std::vector<const StudyRun*> chosen_runs(const Study& study, const Shard& shard, const std::vector<std::string>& names);

}  // namespace gracilis
