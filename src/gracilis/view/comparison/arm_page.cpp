#include <gracilis/view/comparison/arm_page.hpp>

#include <gracilis/core/median.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/view/charts/line_chart.hpp>
#include <gracilis/view/report/html_text.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace gracilis {

using opensim::ArmCourse;

static const char* page_head =
    "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">\n"
    "<title>{0} · Gracilis moment arms</title>\n<style>\n"
    "body {{ margin: 0 auto; max-width: 100rem; padding: 1rem 1.5rem 3rem; color: #1d2327; background: #fff;\n"
    "       font: 15px/1.45 system-ui, \"DejaVu Sans\", sans-serif; }}\n"
    "h1 {{ margin: 0; font-size: 1.5rem; }}\n"
    "h2 {{ margin: 2rem 0 0.5rem; font-size: 1.15rem; border-bottom: 2px solid #1d2327; }}\n"
    ".quiet {{ color: #56606a; }}\n"
    "table {{ border-collapse: collapse; font-variant-numeric: tabular-nums; }}\n"
    "th, td {{ padding: 0.2rem 0.6rem; border-bottom: 1px solid #d5dadf; text-align: right; }}\n"
    "th:first-child, td:first-child {{ text-align: left; }}\n"
    ".charts {{ display: flex; flex-wrap: wrap; gap: 0.5rem; }}\n"
    ".charts svg {{ width: 24rem; max-width: 100%; height: auto; }}\n"
    "</style>\n</head>\n<body>\n<h1>{0}</h1>\n";

/// Courses about one coordinate, which follow each other.
using Courses = std::vector<const ArmCourse*>;

static std::vector<Courses> by_coordinate(const std::vector<ArmCourse>& all) {
  std::vector<Courses> parts;
  for (const ArmCourse& course : all) {
    if (parts.empty() || parts.back().front()->coordinate != course.coordinate) parts.emplace_back();
    parts.back().push_back(&course);
  }
  return parts;
}

static std::string summary_row(const Courses& courses) {
  std::vector<Real> errors;
  Real largest = 0;
  for (const ArmCourse* course : courses) {
    errors.push_back(1000 * course->root_mean_square);
    largest = std::max(largest, 1000 * course->largest);
  }
  const ArmCourse& worst = *courses.front();
  return fmt::format(
      "<tr><td><a href=\"#{0}\">{0}</a></td><td>{1}</td><td>{2:.3f}</td><td>{3:.3f} ({4})</td><td>{5:.3f}</td></tr>\n",
      in_element(worst.coordinate), courses.size(), median(errors), 1000 * worst.root_mean_square,
      in_element(worst.muscle), largest);
}

static std::string arm_chart(const ArmCourse& course) {
  const Real unit = course.rotation ? degrees(1) : 1, to_mm = course.rotation ? 1000 : 1;
  LineChart chart;
  chart.title = fmt::format("{}: differs by {:.2g} mm", course.muscle, 1000 * course.root_mean_square);
  chart.x_label = course.coordinate + (course.rotation ? " (degrees)" : " (m)");
  chart.y_label = course.rotation ? "moment arm (mm)" : "arm (m per m)";
  const auto scaled = [](std::vector<Real> values, Real by) {
    for (Real& each : values) each *= by;
    return values;
  };
  const std::vector<Real> x = scaled(course.at, unit);
  chart.series.push_back({"model's own", x, scaled(course.before, to_mm), Color(0.6, 0.63, 0.66), 6});
  chart.series.push_back({"exported", x, scaled(course.after, to_mm), Color(0.75, 0.1, 0.1), 2});
  return to_svg(chart);
}

void write_arm_page(const std::filesystem::path& path, const std::string& heading,
                    const std::vector<std::string>& lines, const std::vector<ArmCourse>& courses) {
  std::string page = fmt::format(fmt::runtime(page_head), in_element(heading));
  for (const std::string& line : lines) page += "<p class=\"quiet\">" + in_element(line) + "</p>\n";
  page +=
      "<p>Each coordinate goes through the run's range while the others stay at their means. Gray: the model's own "
      "path; red: the exported "
      "one. Muscles with an arm of a millimetre or more; the largest differences come first.</p>\n"
      "<table><tr><th>Coordinate</th><th>Muscles</th><th>Median RMS difference, mm</th><th>Worst RMS difference, "
      "mm</th>"
      "<th>Largest difference, mm</th></tr>\n";
  const std::vector<Courses> parts = by_coordinate(courses);
  for (const Courses& part : parts) page += summary_row(part);
  page += "</table>\n";
  for (const Courses& part : parts) {
    const std::string name = in_element(part.front()->coordinate);
    page += fmt::format("<h2 id=\"{0}\">{0}</h2>\n<div class=\"charts\">\n", name);
    for (const ArmCourse* course : part) page += arm_chart(*course);
    page += "</div>\n";
  }
  write_text_atomically(path, page + "</body>\n</html>\n");
}

}  // namespace gracilis
