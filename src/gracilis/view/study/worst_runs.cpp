#include <gracilis/view/study/worst_runs.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/run/recorded_run.hpp>
#include <gracilis/io/value_reader.hpp>
#include <gracilis/simulate/gates.hpp>
#include <gracilis/study/run_record.hpp>
#include <gracilis/view/pictures/run_picture.hpp>
#include <gracilis/view/report/html_text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gracilis {

/// A value as a share of the bar for its metric; 0 of metrics that have none.
static Real share_of_gate(const std::string& metric, Real value) {
  static const QualityGates gates;
  if (metric == "volume_ratio") return std::abs(value - 1) / gates.volume;
  if (metric == "vertex_depth_beyond_rest") return 1e-3 * value / gates.vertex_depth;
  if (metric == "midpoint_depth_beyond_rest") return 1e-3 * value / gates.midpoint_depth;
  if (metric == "muscle_depth_beyond_rest") return 1e-3 * value / gates.muscle_depth;
  if (metric == "edge_ratio_max_free") return value / gates.free_edge_ratio;
  if (metric == "edge_ratio_max_near") return value / gates.near_edge_ratio;
  if (metric == "spike") return value / gates.spike;
  if (metric == "thickening") return value / gates.thickening;
  if (metric == "thinning") return value / gates.thinning;
  if (metric == "belly_off_place") return 1e-3 * value / gates.belly_off_place;
  if (metric == "slack") return value / gates.slack;
  return 0;
}

void WorstRuns::add(std::size_t run, const RunMeasures& measures) {
  Worst own;
  own.run = run;
  for (const RunMeasures::Row& row : measures.rows)
    for (std::size_t m = 0; m < measures.metrics.size(); ++m) {
      double value = 0;
      if (!parse_number(row.cells[m], value) || !std::isfinite(value)) continue;
      const Real reached = share_of_gate(measures.metrics[m].name, value);
      if (reached <= own.reached) continue;
      own.reached = reached;
      own.frame = row.frame;
      own.muscle = measures.muscles[row.muscle];
      own.metric = measures.metrics[m].name;
      own.value = row.cells[m] + (measures.metrics[m].unit == "1" ? "" : " " + measures.metrics[m].unit);
    }
  if (own.reached == 0) return;
  const auto place =
      std::find_if(worst_.begin(), worst_.end(), [&](const Worst& w) { return w.reached < own.reached; });
  worst_.insert(place, own);
  if (worst_.size() > count_) worst_.pop_back();
}

/// Written beside the study's tables, too.
static std::string frame_picture(const std::filesystem::path& folder, int frame, const std::filesystem::path& file) {
  const std::vector<RecordedRun> runs = {open_recorded_run(folder)};
  const RunPictureOptions options;
  std::vector<RunPainter> painters;
  painters.emplace_back(runs[0], options);
  PictureDrawer drawer;
  write_png(file, drawer.draw(run_picture(runs, painters, {frame}, options)));
  return base64(read_text(file));
}

std::string WorstRuns::text(const Study& study, const std::function<void(const std::string&)>& warn) const {
  if (worst_.empty()) return "<p class=\"quiet\">No run has measures that bars are set for.</p>";
  std::string text;
  bool draws = true;
  for (const Worst& each : worst_) {
    const StudyRun& run = study.runs[each.run];
    text += "<h3>" + in_element(run.name) + "</h3>\n<p>" +
            in_element(fmt::format("{} of {} in frame {}: {}, {:.0f} % of its limit", each.metric, each.muscle,
                                   each.frame, each.value, 100 * each.reached));
    for (std::size_t p = 0; p < study.parameters.size(); ++p)
      if (!run.values[p].empty()) text += "<br>" + in_element(study.parameters[p] + " = " + run.values[p]);
    text += "</p>\n";
    try {
      if (draws)
        text += fmt::format("<p><img alt=\"run {}, frame {}\" src=\"data:image/png;base64,{}\"></p>\n", run.name,
                            each.frame,
                            frame_picture(complete_folder(study, run), each.frame,
                                          study.folder / fmt::format("worst_{}.png", run.name)));
    } catch (const Error& error) {
      draws = error.code() != ExitCode::unsupported;
      warn("no picture of run " + run.name + ": " + error.what());
      text += "<p class=\"quiet\">No picture: " + in_element(error.what()) + "</p>\n";
    }
  }
  return text;
}

}  // namespace gracilis
