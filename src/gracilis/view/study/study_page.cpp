#include <gracilis/view/study/study_page.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/study/outcomes.hpp>
#include <gracilis/study/run_record.hpp>
#include <gracilis/study/sensitivity.hpp>
#include <gracilis/view/report/html_text.hpp>
#include <gracilis/view/report/tables_head.hpp>
#include <gracilis/view/study/study_charts.hpp>
#include <gracilis/view/study/worst_runs.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace gracilis {

namespace embedded {

extern const std::string_view study_html;  // the file beside this one

}  // namespace embedded

namespace {

std::string number_cell(Real value) {
  return std::isfinite(value) ? fmt::format("<td>{:.4g}</td>", value) : "<td>–</td>";
}

/// Least, quarters and largest over the runs.
std::string outcome_table(const std::vector<OutcomeValues>& outcomes) {
  std::string text =
      "<table><tr><th>Outcome</th><th>Unit</th><th>Runs</th><th>Least</th><th>Quarter</th><th>Median</th>"
      "<th>Three quarters</th><th>Largest</th></tr>\n";
  for (const OutcomeValues& outcome : outcomes) {
    std::vector<Real> known;
    for (const Real value : outcome.values)
      if (std::isfinite(value)) known.push_back(value);
    std::sort(known.begin(), known.end());
    text += "<tr><td>" + in_element(title_of(outcome.outcome)) + "</td><td>" +
            in_element(outcome.unit == "1" ? "" : outcome.unit) + fmt::format("</td><td>{}</td>", known.size());
    for (const Real share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const Real at = share * static_cast<Real>(known.empty() ? 0 : known.size() - 1);
      const auto below = static_cast<std::size_t>(at), above = std::min(below + 1, known.size() - 1);
      text += number_cell(known.empty() ? std::nan("")
                                        : known[below] + (at - std::floor(at)) * (known[above] - known[below]));
    }
    text += "</tr>\n";
  }
  return text + "</table>";
}

std::string meaning_of_measure(SamplingKind kind) {
  if (kind == SamplingKind::morris)
    return "Elementary effects (Morris): mean of their sizes, and their standard deviation in brackets, in the "
           "outcome's "
           "unit for a change through the whole range. A deviation as large as the mean tells of interactions or of a "
           "curved dependence.";
  if (kind == SamplingKind::indices)
    return "Sobol indices: the share of the variance that a parameter explains alone and, in brackets, together with "
           "others. They are estimates; with few samples they may leave 0 to 1.";
  return "Spearman's rank correlation of each outcome with each parameter whose values are numbers: 1 or -1 where one "
         "follows the other throughout. The sampling of this study tells no more; morris and indices do.";
}

std::string sensitivity_table(const Study& study, const std::vector<OutcomeValues>& outcomes) {
  if (study.parameters.empty()) return "<p class=\"quiet\">This study has no parameters.</p>";
  std::string text = "<table><tr><th>Outcome</th>";
  for (const std::string& key : study.parameters) text += "<th>" + in_element(key) + "</th>";
  text += "</tr>\n";
  for (const OutcomeValues& outcome : outcomes) {
    const std::vector<Sensitivity> found = sensitivities(study, outcome.values);
    Real most = 0;
    for (const Sensitivity& each : found)
      if (std::isfinite(each.first)) most = std::max(most, std::abs(each.first));
    text += "<tr><td>" + in_element(title_of(outcome.outcome)) + "</td>";
    for (const Sensitivity& each : found) {
      if (!std::isfinite(each.first)) {
        text += "<td>–</td>";
        continue;
      }
      const std::string second = std::isfinite(each.second) ? fmt::format(" ({:.3g})", each.second) : "";
      text +=
          fmt::format("<td{}>{:.3g}{}</td>", std::abs(each.first) == most ? " class=\"most\"" : "", each.first, second);
    }
    text += "</tr>\n";
  }
  return text + "</table>";
}

std::string chart_list(const Study& study, const std::vector<OutcomeValues>& outcomes) {
  std::string text;
  for (const OutcomeValues& outcome : outcomes) {
    if (std::none_of(outcome.values.begin(), outcome.values.end(), [](Real v) { return std::isfinite(v); })) continue;
    text += to_svg(distribution_chart(outcome));
    // Beside it, against what it depends on most.
    const std::vector<Sensitivity> found = sensitivities(study, outcome.values);
    std::size_t most = found.size();
    for (std::size_t p = 0; p < found.size(); ++p)
      if (std::isfinite(found[p].first) &&
          (most == found.size() || std::abs(found[p].first) > std::abs(found[most].first)))
        most = p;
    if (most == found.size()) continue;
    if (const LineChart chart = scatter_chart(study, most, outcome); !chart.series.empty()) text += to_svg(chart);
  }
  return text;
}

std::string parameters_of(const Study& study, std::size_t run) {
  std::string text;
  for (std::size_t p = 0; p < study.parameters.size(); ++p)
    if (!study.runs[run].values[p].empty())
      text += (text.empty() ? "" : ", ") + study.parameters[p] + " = " + study.runs[run].values[p];
  return text;
}

std::string failure_table(const Study& study, const std::vector<RunStanding>& standings) {
  std::string rows;
  for (std::size_t r = 0; r < standings.size(); ++r) {
    if (has_failed(standings[r]))
      rows += "<tr><td>" + in_element(study.runs[r].name) + "</td><td class=\"text\">" +
              in_element(parameters_of(study, r)) + "</td><td class=\"text trouble\">" +
              in_element(standings[r].reason) + "</td></tr>\n";
  }
  if (rows.empty()) return "";
  return "<h2>Failures</h2>\n<div class=\"scroll\"><table><tr><th>Run</th><th>Parameters</th><th>Reason</th></tr>\n" +
         rows + "</table></div>";
}

}  // namespace

void write_study_page(const std::filesystem::path& path, const Study& study, const std::string& version, int worst,
                      const std::function<void(const std::string&)>& warn) {
  InputHashes hashes;
  std::vector<RunStanding> standings;
  std::map<RunState, int> counts;
  OutcomeTable table(study);
  WorstRuns worst_runs(static_cast<std::size_t>(worst));
  for (std::size_t r = 0; r < study.runs.size(); ++r) {
    RunStanding standing = standing_of(study, study.runs[r], version, hashes, AbsentInput::is_passed_over);
    if (standing.state == RunState::complete) {
      try {
        const RunMeasures measures = read_run_measures(complete_folder(study, study.runs[r]));
        table.add(&measures);
        worst_runs.add(r, measures);
      } catch (const InputError& error) {
        standing = {RunState::failed, error.what(), {}};
      }
    }
    if (standing.state != RunState::complete) table.add(nullptr);
    ++counts[standing.state];
    standings.push_back(std::move(standing));
  }
  if (const std::string remark = remark_on_absent(hashes); !remark.empty()) warn(remark);
  const std::vector<OutcomeValues> outcomes = table.finish();
  std::string summary = fmt::format("{} runs:", study.runs.size());
  for (const auto& [state, count] : counts) summary += fmt::format(" {} {},", count, name_of(state));
  summary.back() = '.';
  const std::string name = study.file.stem().string();
  std::string page(embedded::study_html);
  // From the end to the beginning, for what has been filled in may look like a place itself.
  fill(page, "worst", worst_runs.text(study, warn));
  fill(page, "distributions", chart_list(study, outcomes));
  fill(page, "sensitivities", sensitivity_table(study, outcomes));
  fill(page, "measure", meaning_of_measure(study.points.rows() > 0 ? study.sampling.kind : SamplingKind::list));
  fill(page, "outcomes", outcome_table(outcomes));
  fill(page, "failures", failure_table(study, standings));
  fill(page, "summary", summary);
  fill(page, "heading", "Study " + in_element(name));
  fill(page, "head", tables_head(name, "study"));
  write_text_atomically(path, page);
}

}  // namespace gracilis
