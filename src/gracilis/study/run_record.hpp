#pragma once

#include <gracilis/study/study.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace gracilis {

/// Where a study keeps what belongs to a run.
///
///   runs/NAME/             a run folder as `gracilis run` writes it, and in it study.json, how the run came to be, and
///                          study.log; appears whole, by a rename
///   failures/NAME.json     why a run failed; NAME.log is what it said
///   under_way/NAME/        claimed by a process (run.lock), the run that it works on (run), and what defines that
///                          (definition.txt); what a killed one leaves behind is gone on with
///   runs.csv ...           what `collect` writes, see collect.hpp
std::filesystem::path complete_folder(const Study& study, const StudyRun& run);
std::filesystem::path working_folder(const Study& study, const StudyRun& run);  ///< under_way/NAME
std::filesystem::path failure_file(const Study& study, const StudyRun& run);    ///< failures/NAME.json
std::filesystem::path failure_log(const Study& study, const StudyRun& run);     ///< failures/NAME.log

/// How a run came to be: study.json beside its run.json, or what failures/ keeps.
struct RunRecord {
  std::string definition;  ///< run_definition
  int code = 0;            ///< as the program's exit code
  std::string reason;      ///< of a failure, in words
  double seconds = 0;      ///< from the last start of the run to its end
  double processor_seconds = 0;
  double peak_bytes = 0;  ///< most memory that it had at once
  std::string host;
};

/// As JSON. Throws InputError where it cannot be written.
void write_run_record(const std::filesystem::path& file, const RunRecord& record);
/// Nothing where there is none, or one that cannot be read.
std::optional<RunRecord> read_run_record(const std::filesystem::path& file);

/// What a run has come to.
enum class RunState { to_do, interrupted, under_way, stale, failed, complete };

/// "to do", "interrupted", "under way", "stale", "failed", "complete".
std::string name_of(RunState state);

/// Hashes of files that runs read, each computed once; empty of those that are not there.
using InputHashes = std::map<std::filesystem::path, std::string>;

/// What a user should know of those that are not there; empty where all are.
std::string remark_on_absent(const InputHashes& hashes);

/// What it means for a run that a file which it read is not there now. It is passed over where runs are only looked at:
/// results may have been copied without what they were made from.
enum class AbsentInput { makes_stale, is_passed_over };

struct RunStanding {
  RunState state = RunState::to_do;
  std::string reason;               ///< why it failed, is stale, or who works on it
  std::optional<RunRecord> record;  ///< of complete and failed ones
};

/// What the disk says of a run. Complete is what is whole (status and list of hashes in its run.json), was defined as
/// it is now and read files that have not changed since; failed is what cannot come out otherwise, since the definition
/// alone is to blame (exit codes 2 and 5, and the study's limit of time): other failures are to be tried again
/// (to do), and keep their reason.
RunStanding standing_of(const Study& study, const StudyRun& run, const std::string& version, InputHashes& hashes,
                        AbsentInput absent = AbsentInput::makes_stale);

/// Whether it was tried last without success, for good or not.
bool has_failed(const RunStanding& standing);

/// Whether a failure comes back however often it is tried.
bool is_final(const RunRecord& failure);

}  // namespace gracilis
