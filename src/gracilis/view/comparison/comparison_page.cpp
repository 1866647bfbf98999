#include <gracilis/view/comparison/comparison_page.hpp>

#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/view/charts/line_chart.hpp>
#include <gracilis/view/pictures/palette.hpp>
#include <gracilis/view/pictures/run_picture.hpp>
#include <gracilis/view/report/html_text.hpp>
#include <gracilis/view/report/tables_head.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis {

namespace embedded {

extern const std::string_view comparison_html;  // the file beside this one

}  // namespace embedded

namespace {

std::string cell(const ComparisonColumn& column, Real value, Real best) {
  if (!std::isfinite(value)) return "<td>–</td>";
  const std::string text = fmt::format("{:.{}f}", value, column.digits);
  const bool is_best = column.least_is_best && text == fmt::format("{:.{}f}", best, column.digits);
  return is_best ? "<td class=\"best\">" + text + "</td>" : "<td>" + text + "</td>";
}

/// The least finite value of a column.
Real best_of(const std::vector<ComparisonRow>& rows, std::size_t column) {
  Real best = std::numeric_limits<Real>::infinity();
  for (const ComparisonRow& row : rows)
    if (row.values[column] < best) best = row.values[column];
  return best;
}

std::string header(const std::string& first) {
  std::string text = "<tr><th>" + first + "</th>";
  for (const ComparisonColumn& column : comparison_columns()) text += fmt::format("<th>{}</th>", column.title);
  return text + "</tr>\n";
}

/// Of each method the worst muscle; times are those of all muscles together.
std::string method_table(const std::vector<ComparedRun>& runs, const std::vector<ComparisonRow>& rows) {
  const std::vector<ComparisonColumn>& columns = comparison_columns();
  std::vector<ComparisonRow> worst;
  for (const ComparedRun& run : runs) {
    ComparisonRow all{run.method, "", std::vector<Real>(columns.size(), std::nan(""))};
    for (const ComparisonRow& row : rows) {
      if (row.method != run.method) continue;
      for (std::size_t c = 0; c < columns.size(); ++c) {
        Real& sofar = all.values[c];
        const bool is_time = columns[c].key == "mean_ms";
        sofar = !std::isfinite(sofar) ? row.values[c]
                : is_time             ? sofar + row.values[c]
                                      : std::max(sofar, row.values[c]);
      }
    }
    worst.push_back(std::move(all));
  }
  // What fibers do is neither good nor bad, and has no worst muscle.
  std::string text = "<table id=\"methods\"><tr><th>Method</th>";
  for (const ComparisonColumn& column : columns)
    if (column.least_is_best || column.key == "frames")
      text += fmt::format("<th>{}</th>", column.key == "mean_ms" ? "Time per frame of all muscles, ms" : column.title);
  text += "<th>How it deforms muscles</th></tr>\n";
  for (std::size_t r = 0; r < runs.size(); ++r) {
    text += "<tr><td>" + in_element(runs[r].method) + "</td>";
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (columns[c].least_is_best || columns[c].key == "frames")
        text += cell(columns[c], worst[r].values[c], best_of(worst, c));
    text += "<td>" + in_element(runs[r].meaning);
    if (!runs[r].trouble.empty()) text += "<br><span class=\"trouble\">" + in_element(runs[r].trouble) + "</span>";
    text += "</td></tr>\n";
  }
  return text + "</table>";
}

/// A line per method over the frames, against the main coordinate where there is one.
ChartSeries course(const ComparedRun& run, std::size_t number, std::vector<Real> x, std::vector<Real> y) {
  return {run.method, std::move(x), std::move(y), series_color(static_cast<Index>(number)), 2};
}

std::string muscle_charts(const std::vector<ComparedRun>& runs, const std::string& muscle) {
  const RecordedRun& first = runs[0].run;
  const int main = main_coordinate(first);
  const CoordinateLabel label =
      main < 0 ? CoordinateLabel{"frame", ""} : coordinate_label(first.coordinates[static_cast<std::size_t>(main)]);
  const std::string x_label = label.unit.empty() ? label.name : label.name + " (" + label.unit + ")";
  LineChart volume{"volume", "frame", "change (%)", {}}, length{"mean fiber length", x_label, "length (mm)", {}},
      arm{"mean moment arm", x_label, "moment arm (mm)", {}};
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const RecordedRun& run = runs[r].run;
    const auto found = std::find(run.muscles.begin(), run.muscles.end(), muscle);
    const Eigen::MatrixXd ratios = measure_of(run, "volume_ratio");
    if (found == run.muscles.end() || ratios.size() == 0) continue;
    std::vector<Real> frames, changes;
    for (Eigen::Index f = 0; f < ratios.rows(); ++f) {
      frames.push_back(static_cast<Real>(f));
      changes.push_back(100 * (ratios(f, found - run.muscles.begin()) - 1));
    }
    volume.series.push_back(course(runs[r], r, frames, changes));
    FiberCourse fibers = fiber_course(run, muscle);
    for (Real& each : fibers.length) each *= 1000;
    for (Real& each : fibers.moment_arm) each *= 1000;
    length.series.push_back(course(runs[r], r, fibers.coordinate, fibers.length));
    arm.series.push_back(course(runs[r], r, fibers.coordinate, fibers.moment_arm));
  }
  return "<div class=\"charts\">" + to_svg(volume) + to_svg(length) + to_svg(arm) + "</div>\n";
}

std::string muscle_section(const std::vector<ComparedRun>& runs, const std::vector<ComparisonRow>& rows,
                           const std::string& muscle) {
  std::vector<ComparisonRow> own;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(own),
               [&](const ComparisonRow& row) { return row.muscle == muscle; });
  std::string text = "<h3>" + in_element(muscle) + "</h3>\n<div class=\"scroll\"><table>" + header("Method");
  for (const ComparisonRow& row : own) {
    text += "<tr><td>" + in_element(row.method) + "</td>";
    for (std::size_t c = 0; c < row.values.size(); ++c)
      text += cell(comparison_columns()[c], row.values[c], best_of(own, c));
    text += "</tr>\n";
  }
  return text + "</table></div>\n" + muscle_charts(runs, muscle);
}

}  // namespace

std::vector<ComparisonPicture> comparison_pictures(const std::vector<ComparedRun>& runs,
                                                   const std::vector<int>& frames) {
  std::vector<RecordedRun> recorded;
  for (const ComparedRun& run : runs) recorded.push_back(run.run);
  const RunPictureOptions options;
  std::vector<RunPainter> painters;
  for (const RecordedRun& run : recorded) painters.emplace_back(run, options);
  PictureDrawer drawer;
  std::vector<ComparisonPicture> pictures;
  for (const int frame : frames) {
    Picture picture = run_picture(recorded, painters, {frame}, options);
    picture.panel_width = 360;
    picture.columns = std::min(picture.columns, 6);
    // One run that bursts must not make the others small.
    for (Panel& panel : picture.panels)
      for (PaintedSurface& surface : panel.surfaces) surface.framed = surface.framed && surface.name.empty();
    for (Panel& panel : picture.panels) panel.room = painters[0].room();
    const std::filesystem::path file = runs[0].run.folder.parent_path() / fmt::format("frame_{:04d}.png", frame);
    write_png(file, drawer.draw(picture));
    pictures.push_back({frame, read_text(file)});
  }
  return pictures;
}

void write_comparison_page(const std::filesystem::path& path, const std::string& scene,
                           const std::vector<ComparedRun>& runs, const std::vector<ComparisonRow>& rows,
                           const std::vector<ComparisonPicture>& pictures) {
  std::string shown, muscles;
  for (const ComparisonPicture& picture : pictures)
    shown += fmt::format("<p><img alt=\"frame {0}\" src=\"data:image/png;base64,{1}\"></p>\n", picture.frame,
                         base64(picture.png));
  if (pictures.empty()) shown = "<p class=\"quiet\">No pictures: this machine offers no OpenGL.</p>";
  for (const std::string& muscle : runs[0].run.muscles) muscles += muscle_section(runs, rows, muscle);
  std::string page(embedded::comparison_html);
  // From the end to the beginning, for what has been filled in may look like a place itself.
  fill(page, "muscles", muscles);
  fill(page, "pictures", shown);
  fill(page, "methods", method_table(runs, rows));
  fill(page, "heading", in_element(scene) + ": methods side by side");
  fill(page, "head", tables_head(scene, "comparison of methods"));
  write_text_atomically(path, page);
}

}  // namespace gracilis
