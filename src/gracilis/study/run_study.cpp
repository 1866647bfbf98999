#include <gracilis/study/run_study.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/process_mark.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/study/run_claim.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>

namespace gracilis {

namespace fs = std::filesystem;

std::vector<const StudyRun*> chosen_runs(const Study& study, const Shard& shard,
                                         const std::vector<std::string>& names) {
  std::vector<const StudyRun*> runs;
  if (names.empty()) {
    for (Index i = shard.number - 1; i < static_cast<Index>(study.runs.size()); i += shard.count)
      runs.push_back(&study.runs[static_cast<std::size_t>(i)]);
    return runs;
  }
  for (const std::string& name : names) {
    const auto found =
        std::find_if(study.runs.begin(), study.runs.end(), [&](const StudyRun& run) { return run.name == name; });
    if (found == study.runs.end()) {
      std::vector<std::string> known;
      for (const StudyRun& run : study.runs) known.push_back(run.name);
      const std::string near = nearest_word(name, known);
      throw ConfigurationError({"--run", "", "the study has no run '" + name + "'",
                                near.empty() ? "gracilis study plan lists all" : "did you mean '" + near + "'?"});
    }
    runs.push_back(&*found);
  }
  return runs;
}

namespace {

/// Something of a file system went wrong, told as everything else.
void require_moved(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error) throw_write_error(to, "cannot be written: " + error.message());
}

class StudyRunner {
 public:
  StudyRunner(const Study& study, const RunFunction& run, const StudyRunOptions& options)
      : study_(study), run_(run), options_(options) {
    for (const char* part : {"runs", "failures", "under_way"}) create_folder(study.folder / part);
  }

  StudyEnd go() {
    std::vector<const StudyRun*> left = chosen_runs(study_, options_.shard, options_.names);
    for (bool is_first = true; !left.empty() && !end_.interrupted; is_first = false) {
      // What others work on is looked at again until it has come to something.
      if (!is_first) std::this_thread::sleep_for(std::chrono::milliseconds(500));
      std::vector<const StudyRun*> of_others;
      for (const StudyRun* run : left) {
        if (is_asked_to_stop()) end_.interrupted = true;
        if (end_.interrupted) break;
        if (!consider(*run, is_first)) of_others.push_back(run);
      }
      left = std::move(of_others);
    }
    return end_;
  }

 private:
  bool is_asked_to_stop() const { return options_.is_asked_to_stop && options_.is_asked_to_stop(); }
  void say(const std::string& text) const {
    if (options_.say) options_.say(text);
  }

  /// True where nothing is left to do.
  bool is_settled(const StudyRun& run) {
    const RunStanding standing = standing_of(study_, run, options_.version, hashes_);
    if (standing.state == RunState::complete) ++end_.complete_before;
    if (standing.state == RunState::stale) say(run.name + ": made anew, since " + standing.reason);
    if (standing.state == RunState::failed && !options_.retry) {
      ++end_.failed;
      say(run.name + ": has failed: " + standing.reason + " (--retry tries again)");
      return true;
    }
    return standing.state == RunState::complete;
  }

  /// Nothing where another process works on it. What killed ones were writing goes.
  std::optional<RunClaim> claim_of(const StudyRun& run) const {
    const fs::path working = working_folder(study_, run);
    std::optional<RunClaim> claim = RunClaim::take(working);
    if (claim) remove_left_temporaries(working, LeftBy::own_machine);
    return claim;
  }

  /// False where another process works on it.
  bool consider(const StudyRun& run, bool is_first) {
    // Most that is complete is found so, without a claim.
    if (standing_of(study_, run, options_.version, hashes_).state == RunState::complete) {
      ++end_.complete_before;
      if (fs::exists(working_folder(study_, run)))
        if (const std::optional<RunClaim> claim = claim_of(run)) clear_up(run);
      return true;
    }
    const std::optional<RunClaim> claim = claim_of(run);
    if (!claim) {
      if (is_first) say(run.name + ": another process works on it: " + who_claims(working_folder(study_, run)));
      return false;
    }
    if (is_settled(run))
      clear_up(run);
    else
      work_on(run, *claim);
    return true;
  }

  /// Removes what a process left that was killed when its run had come to something, but for the claim, which is this
  /// process's.
  void clear_up(const StudyRun& run) {
    std::error_code ignored;
    for (const char* left : {"old", "run", "definition.txt", "log.txt"})
      fs::remove_all(working_folder(study_, run) / left, ignored);
  }

  /// Whether what lies there is the same run, begun.
  bool can_resume(const fs::path& working, const std::string& definition) const {
    return is_there(working / "run" / "run.json") && text_if_there(working / "definition.txt") == definition;
  }

  void work_on(const StudyRun& run, const RunClaim& claim) {
    const fs::path working = working_folder(study_, run), folder = working / "run";
    const std::string definition = run_definition(study_, run, options_.version);
    bool resume = can_resume(working, definition);
    ChildOutcome outcome;
    for (;;) {
      if (!resume) fs::remove_all(folder);
      if (!resume) write_text_atomically(working / "definition.txt", definition);
      ChildOptions child;
      child.log = working / "log.txt";
      child.most_seconds = study_.most_seconds;
      child.call_every = RunClaim::renewed_every;
      child.call = [&] { claim.renew(); };
      child.is_asked_to_stop = options_.is_asked_to_stop;
      outcome = run_in_child([&] { return run_(run, folder, resume); }, child);
      // What a killed process left may be beyond use; then the run begins again.
      const bool is_hopeless = resume && outcome.code != 0 && outcome.code != static_cast<int>(ExitCode::interrupted) &&
                               !outcome.timed_out && !is_asked_to_stop();
      if (!is_hopeless) break;
      resume = false;
    }
    const bool stopped =
        outcome.code == static_cast<int>(ExitCode::interrupted) || (outcome.code != 0 && is_asked_to_stop());
    if (stopped) {
      end_.interrupted = true;
      return;
    }
    const RunRecord record{definition,
                           outcome.timed_out ? static_cast<int>(ExitCode::quality) : outcome.code,
                           outcome.reason,
                           outcome.seconds,
                           outcome.processor_seconds,
                           outcome.peak_bytes,
                           own_mark().host};
    record.code == 0 ? settle(run, record) : fail(run, record);
  }

  /// Puts the run into its place.
  void settle(const StudyRun& run, const RunRecord& record) {
    const fs::path working = working_folder(study_, run), to = complete_folder(study_, run);
    write_run_record(working / "run" / "study.json", record);
    std::error_code ignored;
    fs::remove_all(working / "old", ignored);
    fs::rename(working / "log.txt", working / "run" / "study.log", ignored);
    if (is_there(to)) {  // of another definition; nobody ever finds half of it in its place
      require_moved(to, working / "old");
      require_moved(working / "run", to);
      fs::remove_all(working / "old", ignored);
    } else {
      require_moved(working / "run", to);
    }
    fs::remove(working / "definition.txt", ignored);
    fs::remove(failure_file(study_, run), ignored);
    fs::remove(failure_log(study_, run), ignored);
    ++end_.done;
    say(fmt::format("{}: complete, {:.1f} s, {:.0f} MB of memory", run.name, record.seconds, 1e-6 * record.peak_bytes));
  }

  void fail(const StudyRun& run, const RunRecord& record) {
    const fs::path working = working_folder(study_, run);
    write_run_record(failure_file(study_, run), record);
    std::error_code ignored;
    fs::rename(working / "log.txt", failure_log(study_, run), ignored);
    fs::remove_all(working / "run", ignored);
    fs::remove(working / "definition.txt", ignored);
    ++end_.failed;
    say(fmt::format("{}: failed: {}", run.name, record.reason));
  }

  const Study& study_;
  const RunFunction& run_;
  const StudyRunOptions& options_;
  InputHashes hashes_;
  StudyEnd end_;
};

}  // namespace

StudyEnd run_study(const Study& study, const RunFunction& run, const StudyRunOptions& options) {
  return StudyRunner(study, run, options).go();
}

}  // namespace gracilis
