#include "study_listing.hpp"

#include <gracilis/io/run/run_size.hpp>
#include <gracilis/io/text_cells.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

std::vector<RunStanding> standings_of(const Study& study, const std::string& version) {
  InputHashes hashes;
  std::vector<RunStanding> standings;
  for (const StudyRun& run : study.runs) standings.push_back(standing_of(study, run, version, hashes));
  return standings;
}

std::string plan_table(const Study& study, const std::vector<RunStanding>& standings) {
  std::string text = "run,state";
  for (const std::string& key : study.parameters) text += "," + csv_cell(key);
  text += ",alone\n";
  for (std::size_t i = 0; i < study.runs.size(); ++i) {
    text += study.runs[i].name + "," + name_of(standings[i].state);
    for (const std::string& value : study.runs[i].values) text += "," + csv_cell(value);
    text += "," + csv_cell(command_alone(study, study.runs[i])) + "\n";
  }
  return text;
}

static double bytes_below(const std::filesystem::path& folder) {
  double bytes = 0;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, ignored))
    if (entry.is_regular_file(ignored)) bytes += static_cast<double>(entry.file_size(ignored));
  return bytes;
}

/// What runs take, by those that are complete.
struct CostEstimate {
  int complete = 0, left = 0;
  double seconds_each = 0, peak_bytes = 0, bytes_each = 0;  ///< a mean, the largest, of the first one
};

static CostEstimate cost_estimate(const Study& study, const std::vector<RunStanding>& standings) {
  CostEstimate cost;
  for (std::size_t i = 0; i < standings.size(); ++i) {
    const bool is_left = standings[i].state != RunState::complete && standings[i].state != RunState::failed;
    cost.left += is_left ? 1 : 0;
    if (standings[i].state != RunState::complete) continue;
    ++cost.complete;
    cost.seconds_each += standings[i].record->seconds;
    cost.peak_bytes = std::max(cost.peak_bytes, standings[i].record->peak_bytes);
    if (cost.complete == 1) cost.bytes_each = bytes_below(complete_folder(study, study.runs[i]));
  }
  if (cost.complete > 0) cost.seconds_each /= cost.complete;
  return cost;
}

std::vector<std::string> estimate_lines(const Study& study, const std::vector<RunStanding>& standings) {
  const CostEstimate cost = cost_estimate(study, standings);
  if (cost.complete == 0)
    return {fmt::format("{} runs; none is complete, so that their cost is not known", standings.size())};
  return {fmt::format("{} runs, {} complete, {} left", standings.size(), cost.complete, cost.left),
          fmt::format("{:.1f} s a run (mean of {}): about {} for what is left in one process, {} in 16",
                      cost.seconds_each, cost.complete, duration_text(cost.seconds_each * cost.left),
                      duration_text(cost.seconds_each * std::ceil(cost.left / 16.0))),
          fmt::format("{} of memory a run at most; {} on the disk a run, {} in all", size_text(cost.peak_bytes),
                      size_text(cost.bytes_each), size_text(cost.bytes_each * static_cast<double>(standings.size())))};
}

nlohmann::ordered_json plan_json(const Study& study, const std::vector<RunStanding>& standings) {
  nlohmann::ordered_json runs = nlohmann::json::array(), each;
  for (std::size_t i = 0; i < study.runs.size(); ++i) {
    nlohmann::ordered_json values = nlohmann::json::object();
    for (std::size_t p = 0; p < study.parameters.size(); ++p) values[study.parameters[p]] = study.runs[i].values[p];
    runs.push_back({{"name", study.runs[i].name},
                    {"state", name_of(standings[i].state)},
                    {"values", values},
                    {"alone", command_alone(study, study.runs[i])}});
  }
  const CostEstimate cost = cost_estimate(study, standings);
  if (cost.complete > 0)
    each = {{"seconds", cost.seconds_each},
            {"peak_memory_mb", 1e-6 * cost.peak_bytes},
            {"disk_mb", 1e-6 * cost.bytes_each}};
  return {{"runs", runs}, {"complete", cost.complete}, {"left", cost.left}, {"cost_of_a_run", each}};
}

static constexpr RunState states[] = {RunState::complete,    RunState::failed, RunState::under_way,
                                      RunState::interrupted, RunState::stale,  RunState::to_do};

static Index count_of(const std::vector<RunStanding>& standings, RunState state) {
  return static_cast<Index>(
      std::count_if(standings.begin(), standings.end(), [&](const RunStanding& each) { return each.state == state; }));
}

nlohmann::ordered_json status_json(const Study& study, const std::vector<RunStanding>& standings) {
  nlohmann::ordered_json counts, runs = nlohmann::json::array();
  for (const RunState state : states) counts[name_of(state)] = count_of(standings, state);
  for (std::size_t i = 0; i < standings.size(); ++i) {
    const RunStanding& standing = standings[i];
    nlohmann::ordered_json run = {{"name", study.runs[i].name}, {"state", name_of(standing.state)}};
    if (!standing.reason.empty()) run["reason"] = standing.reason;
    if (standing.record) {
      run["seconds"] = standing.record->seconds;
      run["peak_memory_mb"] = 1e-6 * standing.record->peak_bytes;
    }
    runs.push_back(std::move(run));
  }
  return {{"study", study.file.string()}, {"folder", study.folder.string()}, {"counts", counts}, {"runs", runs}};
}

std::string status_text(const Study& study, const std::vector<RunStanding>& standings, bool all) {
  std::string text = fmt::format("{}: {} runs in {}\n", study.file.string(), study.runs.size(), study.folder.string());
  for (const RunState state : states) {
    const Index count = count_of(standings, state);
    if (count > 0 || state == RunState::complete) text += fmt::format("{:>8} {}\n", count, name_of(state));
  }
  for (std::size_t i = 0; i < standings.size(); ++i) {
    const bool is_told = all || (standings[i].state != RunState::complete && !standings[i].reason.empty());
    if (!is_told) continue;
    text += study.runs[i].name + ": " + name_of(standings[i].state);
    if (!standings[i].reason.empty()) text += ": " + standings[i].reason.substr(0, standings[i].reason.find('\n'));
    text += "\n";
  }
  return text;
}

}  // namespace gracilis
