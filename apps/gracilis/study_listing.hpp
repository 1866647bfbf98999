#pragma once

#include <gracilis/study/run_record.hpp>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// Of every run, in the study's order.
std::vector<RunStanding> standings_of(const Study& study, const std::string& version);

/// A .csv: run, state, parameters, and the command that does the run alone.
std::string plan_table(const Study& study, const std::vector<RunStanding>& standings);

/// The same for programs, and how many runs are complete and left and what a run costs, null where none is complete.
nlohmann::ordered_json plan_json(const Study& study, const std::vector<RunStanding>& standings);

/// What is left costs, from what is complete: time, room on the disk, memory.
std::vector<std::string> estimate_lines(const Study& study, const std::vector<RunStanding>& standings);

/// How many runs have come to what, and why some did not; with `all`, every run.
std::string status_text(const Study& study, const std::vector<RunStanding>& standings, bool all);
/// The same with every run, for programs: study, folder, counts by state, runs (name, state, reason, seconds,
/// peak_memory_mb).
nlohmann::ordered_json status_json(const Study& study, const std::vector<RunStanding>& standings);

}  // namespace gracilis
