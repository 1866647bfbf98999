#include <gracilis/view/study/study_charts.hpp>

#include <gracilis/io/value_reader.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

static std::string axis_of(const OutcomeValues& outcome) {
  return title_of(outcome.outcome) + (outcome.unit == "1" ? "" : " (" + outcome.unit + ")");
}

LineChart distribution_chart(const OutcomeValues& outcome) {
  std::vector<Real> known;
  for (const Real value : outcome.values)
    if (std::isfinite(value)) known.push_back(value);
  const auto [low, high] = std::minmax_element(known.begin(), known.end());
  const int parts = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(known.size()))), 1, 20);
  const Real begin = *low, width = *high > *low ? (*high - *low) / parts : 1;
  std::vector<Real> counts(static_cast<std::size_t>(parts), 0);
  for (const Real value : known)
    counts[static_cast<std::size_t>(std::min(int((value - begin) / width), parts - 1))] += 1;
  ChartSeries steps{"", {begin}, {0}, series_color(0), 2};
  for (std::size_t part = 0; part < counts.size(); ++part)
    for (const std::size_t end : {part, part + 1}) {
      steps.x.push_back(begin + static_cast<Real>(end) * width);
      steps.y.push_back(counts[part]);
    }
  steps.x.push_back(begin + parts * width);
  steps.y.push_back(0);
  return {title_of(outcome.outcome), axis_of(outcome), "runs", {steps}, {}};
}

LineChart scatter_chart(const Study& study, std::size_t parameter, const OutcomeValues& outcome) {
  LineChart chart{"", study.parameters[parameter], axis_of(outcome), {}, {}};
  std::vector<std::pair<Real, Real>> marks;
  for (std::size_t run = 0; run < outcome.values.size(); ++run) {
    double number = 0;
    if (std::isfinite(outcome.values[run]) && parse_number(study.runs[run].values[parameter], number))
      marks.emplace_back(number, outcome.values[run]);
  }
  if (marks.empty()) return chart;
  Real low_x = marks[0].first, high_x = low_x, low_y = marks[0].second, high_y = low_y;
  for (const auto& [x, y] : marks) {
    low_x = std::min(low_x, x), high_x = std::max(high_x, x);
    low_y = std::min(low_y, y), high_y = std::max(high_y, y);
  }
  // Small crosses: a chart knows lines only.
  const Real across = 0.01 * (high_x - low_x), up = 0.015 * (high_y - low_y), none = std::nan("");
  ChartSeries crosses{"", {}, {}, series_color(0), 1.5};
  for (const auto& [x, y] : marks) {
    for (const Real value : {x - across, x + across, none, x, x, none}) crosses.x.push_back(value);
    for (const Real value : {y, y, none, y - up, y + up, none}) crosses.y.push_back(value);
  }
  chart.series.push_back(std::move(crosses));
  return chart;
}

}  // namespace gracilis
