#include <gracilis/view/calibration/calibration_page.hpp>

#include <gracilis/calibrate/calibration_files.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/view/charts/line_chart.hpp>
#include <gracilis/view/report/html_text.hpp>
#include <gracilis/view/report/tables_head.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gracilis {

namespace embedded {

extern const std::string_view calibration_html;  // the file beside this one

}  // namespace embedded

namespace {

std::string cell(Real value, const char* kind = "") {
  return std::isfinite(value) ? fmt::format("<td{}>{:.4g}</td>", kind, value) : "<td>–</td>";
}

std::string five(Real value) { return std::isfinite(value) ? fmt::format("<td>{:.5g}</td>", value) : "<td>–</td>"; }

std::string text_cell(const std::string& text, const char* kind = "text") {
  return fmt::format("<td class=\"{}\">{}</td>", kind, in_element(text));
}

std::string parameter_table(const CalibrationResult& result) {
  std::string text =
      "<table><tr><th>Parameter</th><th>Start</th><th>Calibrated</th><th>Standard error</th><th>95 of 100: from</th>"
      "<th>to</th><th>Bounds</th><th>Scale</th><th>Remark</th></tr>\n";
  for (std::size_t p = 0; p < result.calibration.parameters.size(); ++p) {
    const StudyParameter& setting = result.calibration.parameters[p].setting;
    const ParameterEstimate estimate = estimate_of(result, p);
    text += "<tr>" + text_cell(setting.key) + cell(std::stod(result.start_values[p])) +
            fmt::format("<td class=\"most\">{:.5g}</td>", estimate.value) + cell(estimate.error) + five(estimate.from) +
            five(estimate.to) + fmt::format("<td>{:g} to {:g}</td>", setting.low, setting.high) +
            text_cell(setting.logarithmic ? "log" : "linear") +
            text_cell(result.uncertainty.remarks[p], "text trouble") + "</tr>\n";
  }
  return text + "</table>";
}

std::string about_uncertainty(const CalibrationResult& result) {
  std::string text =
      "Errors are those of the curvature at the lowest point, with the variance of what is left between scene and "
      "targets. Neighboring values of a curve err alike, so true errors are larger, by up to the root of how many "
      "values err together.";
  for (const std::vector<Index>& together : result.uncertainty.together) {
    if (together.size() < 2) continue;
    text += " The targets determine only a combination of";
    for (std::size_t i = 0; i < together.size(); ++i)
      text += (i == 0                     ? " "
               : i + 1 == together.size() ? " and "
                                          : ", ") +
              result.calibration.parameters[static_cast<std::size_t>(together[i])].setting.key;
    text += ": change one and the others make up for it.";
  }
  return in_element(text);
}

std::string correlation_table(const CalibrationResult& result) {
  const auto& parameters = result.calibration.parameters;
  if (parameters.size() < 2 || result.uncertainty.residual_variance == 0) return "";
  std::string text = "<div class=\"scroll\"><table><tr><th>Correlation</th>";
  for (const CalibrationParameter& each : parameters) text += "<th>" + in_element(each.setting.key) + "</th>";
  text += "</tr>\n";
  for (std::size_t row = 0; row < parameters.size(); ++row) {
    text += "<tr>" + text_cell(parameters[row].setting.key);
    for (std::size_t column = 0; column < parameters.size(); ++column)
      text += fmt::format("<td>{:.2f}</td>",
                          result.uncertainty.correlations(static_cast<Index>(row), static_cast<Index>(column)));
    text += "</tr>\n";
  }
  return text + "</table></div>";
}

std::string target_table(const CalibrationResult& result) {
  std::string text =
      "<table><tr><th>Target</th><th>Kind</th><th>Muscle</th><th>Values</th><th>Unit</th><th>Before</th><th>After</th>"
      "<th>Tolerance</th><th>Weight</th></tr>\n";
  for (std::size_t t = 0; t < result.calibration.targets.size(); ++t) {
    const CalibrationTarget& target = result.calibration.targets[t];
    const Real factor = shown_factor(target.kind);
    const auto row = [&](const std::string& muscle, std::size_t values, Real before, Real after, const char* kind) {
      text += "<tr>" + text_cell(target.name) +
              text_cell(words_of(target.kind) + (target.held_out ? ", held out" : "")) + text_cell(muscle) +
              fmt::format("<td>{}</td>", values) + text_cell(shown_unit(target.kind)) + cell(factor * before) +
              cell(factor * after, kind) + fmt::format("<td>{:g}</td>", factor * target.tolerance) +
              (target.held_out ? "<td>–</td>" : fmt::format("<td>{:g}</td>", target.weight)) + "</tr>\n";
    };
    std::size_t values = 0;
    for (std::size_t p = 0; p < target.parts.size(); ++p) {
      const TargetPart& part = target.parts[p];
      values += result.after[t][p].size();
      row(part.muscle + (part.source.empty() ? "" : " (" + part.source + ")"), result.after[t][p].size(),
          part_rms(target, part, result.before[t][p]), part_rms(target, part, result.after[t][p]), "");
    }
    if (target.parts.size() > 1)
      row("all", values, target_rms(target, result.before[t]), target_rms(target, result.after[t]), " class=\"most\"");
  }
  return text + "</table>";
}

/// Curves beside their target, of the targets that are held out or of the others.
std::string curve_charts(const CalibrationResult& result, bool held_out) {
  std::string text;
  for (std::size_t t = 0; t < result.calibration.targets.size(); ++t) {
    const CalibrationTarget& target = result.calibration.targets[t];
    if (!is_curve(target.kind) || target.held_out != held_out) continue;
    for (std::size_t p = 0; p < target.parts.size(); ++p) {
      const TargetPart& part = target.parts[p];
      if (part.at.size() < 2) continue;  // the table has it
      LineChart chart{target.name + ": " + part.muscle,
                      target.coordinate + " (degrees)",
                      (target.kind == TargetKind::lengths ? "length (mm)" : "moment arm (mm)"),
                      {},
                      {}};
      const auto add = [&](const std::string& name, const std::vector<Real>& values, const Color& color, Real width) {
        ChartSeries series{name, {}, {}, color, width};
        for (std::size_t i = 0; i < values.size(); ++i) {
          series.x.push_back(degrees(part.at[i]));
          series.y.push_back(1e3 * values[i]);
        }
        chart.series.push_back(std::move(series));
      };
      add("target", part.values, Color::Constant(0.55), 4);
      add("before", result.before[t][p], series_color(1), 1.5);
      add("after", result.after[t][p], series_color(0), 2);
      text += to_svg(chart);
    }
  }
  return text;
}

/// Objectives over evaluations, and the lowest so far, by their logarithm.
std::string history_chart(const CalibrationResult& result) {
  const Real least = 1e-12;
  ChartSeries each{"each", {}, {}, Color::Constant(0.65), 1}, best{"lowest so far", {}, {}, series_color(0), 2};
  Real lowest = std::numeric_limits<Real>::infinity();
  for (std::size_t i = 0; i < result.history.size(); ++i) {
    const Real objective = result.history[i].objective;
    each.x.push_back(static_cast<Real>(i + 1));
    each.y.push_back(std::log10(std::max(objective, least)));
    if (std::isnan(objective)) each.y.back() = objective;
    if (objective < lowest) lowest = objective;
    best.x.push_back(static_cast<Real>(i + 1));
    best.y.push_back(std::log10(std::max(lowest, least)));
  }
  return to_svg({"Objective", "evaluation", "log10 of the objective", {each, best}, {}});
}

std::string summary_of(const CalibrationResult& result) {
  Index failed = 0;
  for (const HistoryRow& row : result.history) failed += std::isnan(row.objective) ? 1 : 0;
  std::string text = fmt::format(
      "Objective {:.4g} before, {:.4g} after: over all targets, weight × mean square of differences over "
      "tolerances. {} evaluations",
      result.start_objective, result.objective, result.evaluations);
  if (failed > 0) text += fmt::format(", of which {} failed", failed);
  return text + "; it ended since " + result.stopped + ".";
}

}  // namespace

void write_calibration_page(const std::filesystem::path& path, const CalibrationResult& result,
                            const std::string& use) {
  const std::string name = result.calibration.file.stem().string();
  std::string held_out = curve_charts(result, true);
  if (!held_out.empty()) held_out = "<h2>Held out</h2>\n<div class=\"charts\">" + held_out + "</div>";
  std::string page(embedded::calibration_html);
  // From the end to the beginning, for what has been filled in may look like a place itself.
  fill(page, "use", in_element(use));
  fill(page, "history", history_chart(result));
  fill(page, "held_out", held_out);
  fill(page, "charts", curve_charts(result, false));
  fill(page, "targets", target_table(result));
  fill(page, "correlations", correlation_table(result));
  fill(page, "uncertainty", about_uncertainty(result));
  fill(page, "parameters", parameter_table(result));
  fill(page, "summary", in_element(summary_of(result)));
  fill(page, "heading", "Calibration " + in_element(name));
  fill(page, "head", tables_head(name, "calibration"));
  write_text_atomically(path, page);
}

}  // namespace gracilis
