#include <gracilis/study/run_record.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/whole_number.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/content_hash.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/json_file.hpp>
#include <gracilis/io/run/output_hashes.hpp>
#include <gracilis/io/run/run_manifest.hpp>
#include <gracilis/study/run_claim.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace gracilis {

namespace fs = std::filesystem;

fs::path complete_folder(const Study& study, const StudyRun& run) { return study.folder / "runs" / run.name; }
fs::path working_folder(const Study& study, const StudyRun& run) { return study.folder / "under_way" / run.name; }
fs::path failure_file(const Study& study, const StudyRun& run) {
  return study.folder / "failures" / (run.name + ".json");
}
fs::path failure_log(const Study& study, const StudyRun& run) {
  return study.folder / "failures" / (run.name + ".log");
}

void write_run_record(const fs::path& file, const RunRecord& record) {
  const nlohmann::ordered_json json = {{"definition", record.definition},
                                       {"definition_sha256", content_hash_of(record.definition)},
                                       {"exit_code", record.code},
                                       {"reason", record.reason},
                                       {"seconds", record.seconds},
                                       {"processor_seconds", record.processor_seconds},
                                       {"peak_memory_bytes", record.peak_bytes},
                                       {"host", record.host}};
  write_text_atomically(file, json_text(json));
}

std::optional<RunRecord> read_run_record(const fs::path& file) {
  try {
    if (!is_there(file)) return std::nullopt;
    const nlohmann::ordered_json json = read_json(file);
    RunRecord record;
    record.definition = json.at("definition").get<std::string>();
    const std::optional<int> code = whole_number<int>(json.at("exit_code").get<double>(), 0, 255);
    if (!code) return std::nullopt;
    record.code = *code;
    record.reason = json.at("reason").get<std::string>();
    record.seconds = json.at("seconds").get<double>();
    record.processor_seconds = json.at("processor_seconds").get<double>();
    record.peak_bytes = json.at("peak_memory_bytes").get<double>();
    record.host = json.at("host").get<std::string>();
    return record;
  } catch (const InputError&) {
    return std::nullopt;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

std::string name_of(RunState state) {
  switch (state) {
    case RunState::to_do:
      return "to do";
    case RunState::interrupted:
      return "interrupted";
    case RunState::under_way:
      return "under way";
    case RunState::stale:
      return "stale";
    case RunState::failed:
      return "failed";
    case RunState::complete:
      return "complete";
  }
  return "";
}

bool is_final(const RunRecord& failure) {
  return failure.code == static_cast<int>(ExitCode::usage) || failure.code == static_cast<int>(ExitCode::quality);
}

bool has_failed(const RunStanding& standing) {
  return standing.state == RunState::failed || (standing.record && standing.record->code != 0);
}

std::string remark_on_absent(const InputHashes& hashes) {
  const auto is_absent = [](const auto& input) { return input.second.empty(); };
  const auto first = std::find_if(hashes.begin(), hashes.end(), is_absent);
  if (first == hashes.end()) return "";
  return fmt::format("{} of {} files that runs read are not there ({}): whether they have changed is not known",
                     std::count_if(first, hashes.end(), is_absent), hashes.size(), first->first.string());
}

/// The file's hash; empty where it is not there. One that cannot be read is told of each time.
static const std::string& input_hash(const fs::path& file, InputHashes& hashes) {
  if (const auto known = hashes.find(file); known != hashes.end()) return known->second;
  std::error_code ignored;
  std::string hash = fs::exists(file, ignored) ? content_hash(file) : std::string();
  return hashes.emplace(file, std::move(hash)).first->second;
}

/// Why a run folder is not what the run would make now; empty where it is.
static std::string why_stale(const fs::path& folder, const std::string& definition,
                             const std::optional<RunRecord>& record, InputHashes& hashes, AbsentInput absent) {
  if (!record) return "study.json is missing or damaged";
  if (record->definition != definition) return "the study defines it otherwise now";
  try {
    const nlohmann::ordered_json manifest = read_manifest(folder);
    if (manifest.value("status", "") != "complete") return "run.json does not say that it is complete";
    if (!is_there(folder / output_hashes_name) ||
        manifest.value("outputs_sha256", "") != content_hash(folder / output_hashes_name))
      return std::string(output_hashes_name) + " is missing or has changed";
    for (const nlohmann::ordered_json& input : manifest.value("inputs", nlohmann::ordered_json::array())) {
      const std::string file = input.value("file", ""), hash = input_hash(file, hashes);
      if (hash.empty() && absent == AbsentInput::is_passed_over) continue;
      if (hash.empty() || hash != input.value("sha256", "")) return file + " is missing or has changed since";
    }
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

RunStanding standing_of(const Study& study, const StudyRun& run, const std::string& version, InputHashes& hashes,
                        AbsentInput absent) {
  RunStanding standing;
  const std::string definition = run_definition(study, run, version);
  const fs::path complete = complete_folder(study, run), working = working_folder(study, run);
  if (is_there(complete)) {
    standing.record = read_run_record(complete / "study.json");
    standing.reason = why_stale(complete, definition, standing.record, hashes, absent);
    standing.state = standing.reason.empty() ? RunState::complete : RunState::stale;
    if (standing.state == RunState::complete) return standing;
  }
  if (const std::string who = who_claims(working); !who.empty()) return {RunState::under_way, who, {}};
  const std::optional<RunRecord> failure = read_run_record(failure_file(study, run));
  if (failure && failure->definition == definition) {
    standing.record = failure;
    standing.reason = failure->reason;
    if (is_final(*failure)) standing.state = RunState::failed;
    if (is_final(*failure)) return standing;
  }
  if (standing.state == RunState::to_do && is_there(working / "run")) standing.state = RunState::interrupted;
  return standing;
}

}  // namespace gracilis
