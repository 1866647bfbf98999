#include <gracilis/study/outcomes.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/suggestions.hpp>
#include <gracilis/io/value_reader.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis {

static Real outcome_of(const StudyOutcome& outcome, const RunMeasures& run) {
  using Statistic = StudyOutcome::Statistic;
  const auto metric = std::find_if(run.metrics.begin(), run.metrics.end(),
                                   [&](const MetricName& each) { return each.name == outcome.metric; });
  if (metric == run.metrics.end()) return std::numeric_limits<Real>::quiet_NaN();
  const auto column = static_cast<std::size_t>(metric - run.metrics.begin());
  std::vector<Real> values;
  int last_frame = -1;
  for (const RunMeasures::Row& row : run.rows) {
    double value = 0;
    const bool is_meant = outcome.muscle.empty() || run.muscles[row.muscle] == outcome.muscle;
    if (!is_meant || !parse_number(row.cells[column], value) || !std::isfinite(value)) continue;
    if (outcome.statistic == Statistic::last && row.frame != last_frame) values.clear();
    last_frame = row.frame;
    values.push_back(value);
  }
  if (values.empty()) return std::numeric_limits<Real>::quiet_NaN();
  if (outcome.statistic == Statistic::largest) return *std::max_element(values.begin(), values.end());
  if (outcome.statistic == Statistic::smallest) return *std::min_element(values.begin(), values.end());
  Real sum = 0;
  for (const Real value : values) sum += value;
  return sum / static_cast<Real>(values.size());
}

static bool differs(const std::vector<Real>& values) {
  Real low = std::numeric_limits<Real>::infinity(), high = -low;
  for (const Real value : values)
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  return low < high;
}

OutcomeTable::OutcomeTable(const Study& study) : study_(study) {
  for (const StudyOutcome& outcome : study.outcomes) outcomes_.push_back({outcome, "", {}});
}

void OutcomeTable::add(const RunMeasures* run) {
  const Real unknown = std::numeric_limits<Real>::quiet_NaN();
  if (run) {
    muscles_.insert(run->muscles.begin(), run->muscles.end());
    for (const MetricName& metric : run->metrics) {
      // How long a computer took is told by runs.csv, and is no result.
      const bool is_new = units_.emplace(metric.name, metric.unit).second;
      if (is_new && study_.outcomes.empty() && metric.name != "computing_time")
        outcomes_.push_back({{metric.name, "", {}}, "", std::vector<Real>(runs_, unknown)});
    }
  }
  for (OutcomeValues& each : outcomes_) each.values.push_back(run ? outcome_of(each.outcome, *run) : unknown);
  ++runs_;
}

std::vector<OutcomeValues> OutcomeTable::finish() const {
  std::vector<std::string> metrics;
  for (const auto& [name, unit] : units_) metrics.push_back(name);
  const std::vector<std::string> muscles(muscles_.begin(), muscles_.end());
  std::vector<Problem> problems;
  std::vector<OutcomeValues> found;
  for (const OutcomeValues& each : outcomes_) {
    const auto unit = units_.find(each.outcome.metric);
    if (unit == units_.end() && !metrics.empty())
      problems.push_back({study_.file.string(), "[[outcomes]]", "no run has a metric '" + each.outcome.metric + "'",
                          suggestion(each.outcome.metric, metrics)});
    if (!each.outcome.muscle.empty() && !muscles.empty() && !muscles_.contains(each.outcome.muscle))
      problems.push_back({study_.file.string(), "[[outcomes]]", "no run has a muscle '" + each.outcome.muscle + "'",
                          suggestion(each.outcome.muscle, muscles)});
    if (unit == units_.end() || (study_.outcomes.empty() && !differs(each.values))) continue;
    found.push_back(each);
    found.back().unit = unit->second;
  }
  if (!problems.empty()) throw ConfigurationError(problems);
  return found;
}

std::string title_of(const StudyOutcome& outcome) {
  const std::string of = outcome.muscle.empty() ? "" : " of " + outcome.muscle;
  return name_of(outcome.statistic) + " " + outcome.metric + of;
}

}  // namespace gracilis
