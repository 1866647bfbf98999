#include <gracilis/view/session/moment_arm_files.hpp>

#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/tables/force_table.hpp>
#include <gracilis/io/tables/table.hpp>
#include <gracilis/scene/names.hpp>
#include <gracilis/simulate/moment_arms.hpp>
#include <gracilis/view/charts/run_charts.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace gracilis {

namespace {

std::vector<Real> as_list(const Eigen::VectorXd& values) { return {values.begin(), values.end()}; }

std::string by_force(const std::string& muscle) { return muscle + "_by_force"; }

/// Where the method knows forces: what a muscle does in the coordinate's motion, over its tension. A column for each
/// muscle behind all others.
void add_arms_by_force(const std::filesystem::path& folder, const Scene& scene, const MovedCoordinate& moved,
                       Table& table) {
  if (!is_there(folder / force_file)) return;
  const Table forces = rows_of_range(read_table(folder / force_file), scene);
  for (const Muscle& muscle : scene.muscles) {
    const std::optional<Eigen::Index> tension = column_of(forces, muscle.name + "_tension");
    const std::optional<Eigen::Index> moment = column_of(forces, muscle.name + "_moment_" + moved.name);
    if (!tension || !moment) continue;
    table.columns.push_back(by_force(muscle.name));
    table.values.conservativeResize(Eigen::NoChange, table.values.cols() + 1);
    const Eigen::VectorXd tensions = forces.values.col(*tension);
    table.values.rightCols<1>() =
        (tensions.array() > 0).select(forces.values.col(*moment).array() / tensions.array(), 0).matrix();
  }
}

/// Says how arms by lengths and by forces differ.
void tell_by_force(const Table& table, const std::string& muscle, const Eigen::VectorXd& arms,
                   MomentArmReport& report) {
  const std::optional<Eigen::Index> column = column_of(table, by_force(muscle));
  if (!column) return;
  const Eigen::VectorXd others = table.values.col(*column);
  report.lines.push_back(fmt::format("  by its forces {:.1f} to {:.1f} mm, {:.1f} mm RMS from that",
                                     1e3 * others.minCoeff(), 1e3 * others.maxCoeff(),
                                     1e3 * (others - arms).norm() / std::sqrt(static_cast<Real>(arms.size()))));
}

std::vector<ArmCurve> references_of(const std::vector<ArmCurve>& all, const std::string& muscle,
                                    const MovedCoordinate& moved) {
  std::vector<ArmCurve> found;
  for (const ArmCurve& curve : all)
    if (curve.muscle == muscle && (curve.coordinate.empty() || curve.coordinate == moved.name)) found.push_back(curve);
  return found;
}

/// Dark among the pale lines of fibers; its name tells how far off the arms are.
ChartSeries reference_series(const ArmCurve& curve, const ArmComparison& comparison, int number) {
  ChartSeries series{curve.source, {}, {}, Color::Constant(0.14 * (number % 4)), 2.5};
  if (comparison.angles > 0) series.name += fmt::format(", {:.1f} mm RMS", 1e3 * comparison.rms);
  for (std::size_t i = 0; i < curve.angles.size(); ++i) {
    series.x.push_back(degrees(curve.angles[i]));
    series.y.push_back(1e3 * curve.arms[i]);
  }
  return series;
}

/// Says how the arms of the report's last muscle lie beside the curves; rows of reference.csv.
std::string compared(const std::string& muscle, const std::vector<Real>& angles, const std::vector<Real>& arms,
                     const std::vector<ArmCurve>& curves, MomentArmReport& report) {
  const Real per_degree = 1e3 * radians(1);
  const Real beyond_band = 1e3 * mean_distance_from_band(angles, arms, curves);
  std::string rows;
  for (const ArmCurve& curve : curves) {
    const ArmComparison c = compare_arms(angles, arms, curve);
    if (c.angles == 0) continue;
    report.muscles.back().beside.emplace_back(curve.source, c);
    std::string line = fmt::format("  beside {}: {:.1f} mm RMS, {:.1f} mm at most, from {:.0f} to {:.0f} degrees",
                                   curve.source, 1e3 * c.rms, 1e3 * c.largest, degrees(c.from), degrees(c.to));
    if (std::isfinite(c.slope))
      line += fmt::format("; slope at 0 {:.2f} mm per degree, there {:.2f}", per_degree * c.slope,
                          per_degree * c.reference_slope);
    report.lines.push_back(line);
    rows += fmt::format("{},{},{},{:.2f},{:.2f},{:.3f},{:.3f},{:.4f},{:.4f},{:.3f}\n", muscle, curve.source, c.angles,
                        degrees(c.from), degrees(c.to), 1e3 * c.rms, 1e3 * c.largest, per_degree * c.slope,
                        per_degree * c.reference_slope, beyond_band);
  }
  if (curves.size() > 1 && std::isfinite(beyond_band))
    report.lines.push_back(
        fmt::format("  beyond the band of all {}: {:.1f} mm on average", curves.size(), beyond_band));
  return rows;
}

/// Whether the run has no fibers, with a warning that says why.
bool has_no_fibers(const std::filesystem::path& folder, const Scene& scene, MomentArmReport& report) {
  if (is_there(folder / "fiber_lengths.sto")) return false;
  const bool any = std::any_of(scene.muscles.begin(), scene.muscles.end(),
                               [](const Muscle& muscle) { return muscle.fibers.count > 0; });
  report.warnings.emplace_back(any ? "fibers were left out, so there are no moment arms; leave out '--no-fibers'"
                                   : "no muscle has fibers, so there are no moment arms; set 'fibers.count' above 0");
  return true;
}

/// `where` says in which poses.
std::string arms_text(const MuscleArms& arms, const std::string& where) {
  const Real least = 1e3 * arms.least, most = 1e3 * arms.most;
  if (arms.translation)
    return fmt::format("{}: shortens by {:.1f} to {:.1f} mm per m of {}", arms.muscle, least, most, arms.coordinate);
  return fmt::format("{}: moment arm about {} {:.1f} to {:.1f} mm{}, largest step {:.3f} mm per degree", arms.muscle,
                     arms.coordinate, least, most, where, 1e3 * arms.largest_step);
}

/// Says how a muscle acts in the coordinate's motion.
void tell_arms(const std::string& muscle, const MovedCoordinate& moved, const Eigen::VectorXd& arms, Real largest_step,
               MomentArmReport& report, const std::string& where = "") {
  report.muscles.push_back({muscle, moved.name, moved.translation, arms.minCoeff(), arms.maxCoeff(), largest_step});
  report.lines.push_back(arms_text(report.muscles.back(), where));
}

using Lines = std::vector<std::vector<Index>>;

/// The values of the other coordinates that moved, in a row of a table.
std::string others_text(const Table& table, const Scene& scene, const std::vector<MovedCoordinate>& all,
                        const MovedCoordinate& moved, Index row) {
  std::string text;
  for (const MovedCoordinate& other : all) {
    if (other.name == moved.name) continue;
    const Real shown =
        table.values(row, column_of(table, other.name).value()) * chart_coordinate(scene, other.name).factor;
    text += fmt::format("{}{} {:.4g}", text.empty() ? "" : ", ", other.name, shown);
  }
  return text;
}

/// One muscle's arms on each of at most seven of the lines, as many of those as lie evenly among all.
LineChart grid_chart(const Table& table, const Scene& scene, const std::vector<MovedCoordinate>& all,
                     const MovedCoordinate& moved, const Lines& lines, Eigen::Index column, const std::string& title) {
  const std::size_t shown = std::min<std::size_t>(7, lines.size());
  const ChartCoordinate coordinate = chart_coordinate(scene, moved.name);
  const Eigen::Index along = column_of(table, moved.name).value();
  LineChart chart{title, coordinate.label, moved.translation ? "shortening (mm per m)" : "moment arm (mm)", {}};
  for (std::size_t i = 0; i < shown; ++i) {
    const Real late = shown == 1 ? 0 : static_cast<Real>(i) / static_cast<Real>(shown - 1);
    const std::vector<Index>& line = lines[shown == 1 ? 0 : i * (lines.size() - 1) / (shown - 1)];
    ChartSeries series{others_text(table, scene, all, moved, line.front()),
                       {},
                       {},
                       (1 - late) * Color(0.1, 0.3, 0.7) + late * Color(0.85, 0.35, 0.1),
                       2};
    for (const Index row : line) {
      series.x.push_back(table.values(row, along) * coordinate.factor);
      series.y.push_back(1e3 * table.values(row, column));
    }
    chart.series.push_back(series);
  }
  return chart;
}

/// The largest change per degree between neighbors along the lines, m.
Real largest_step(const Lines& lines, const Eigen::VectorXd& values, const Eigen::VectorXd& arms) {
  Real largest = 0;
  for (const std::vector<Index>& line : lines)
    largest = std::max(largest, largest_step_per_degree(values(line), arms(line)));
  return largest;
}

/// Of all combinations of several coordinates' values.
MomentArmReport write_grids(const std::filesystem::path& folder, const Scene& scene,
                            const std::vector<MovedCoordinate>& moved) {
  MomentArmReport report;
  if (has_no_fibers(folder, scene, report)) return report;
  create_folder(folder / "plots");
  std::set<std::string> taken;
  for (const MovedCoordinate& each : moved) {
    const Table table = moment_arm_table(folder, scene, each);
    const Lines lines = lines_along(table, scene, each);
    const Eigen::VectorXd values = values_of(table, each);
    const std::string stem = "moment_arms_about_" + file_name_of(each.name, taken);
    write_sto(folder / (stem + ".sto"), table);
    for (const Muscle& muscle : scene.muscles) {
      const std::optional<Eigen::Index> column = column_of(table, muscle.name);
      if (!column) continue;
      const Eigen::VectorXd arms = table.values.col(*column);
      tell_arms(muscle.name, each, arms, largest_step(lines, values, arms), report,
                fmt::format(" in {} poses", arms.size()));
      if (const std::string text = doubtful_text(table, muscle.name); !text.empty()) report.lines.push_back(text);
      write_chart(folder / "plots" / (stem + "_" + muscle.name + ".svg"),
                  grid_chart(table, scene, moved, each, lines, *column, muscle.name + ": about " + each.name));
    }
  }
  return report;
}

/// Along the range of one.
MomentArmReport write_curves(const std::filesystem::path& folder, const Scene& scene, const MovedCoordinate& moved,
                             const std::vector<ArmCurve>& references) {
  MomentArmReport report;
  if (has_no_fibers(folder, scene, report)) return report;
  create_folder(folder / "plots");
  Table table = moment_arm_table(folder, scene, moved);
  add_arms_by_force(folder, scene, moved, table);
  write_sto(folder / "moment_arms.sto", table);

  const ChartCoordinate coordinate = chart_coordinate(scene, moved.name);
  const std::string title = moved.translation ? "shortening" : "moment arms";
  const std::string y_label = moved.translation ? "shortening (mm per m)" : "moment arm (mm)";
  const Eigen::VectorXd angles = values_of(table, moved);
  std::string comparisons;
  std::vector<std::string> muscles;
  for (const Muscle& muscle : scene.muscles) {
    const std::optional<Eigen::Index> found = column_of(table, muscle.name);
    if (!found) continue;
    muscles.push_back(muscle.name);
    const Eigen::VectorXd arms = table.values.col(*found);
    LineChart chart = fiber_chart(table, coordinate, muscle.name, muscle.name + ": " + title, y_label);
    tell_arms(muscle.name, moved, arms, largest_step_per_degree(angles, arms), report);
    if (!moved.translation) {
      const std::vector<ArmCurve> curves = references_of(references, muscle.name, moved);
      comparisons += compared(muscle.name, as_list(angles), as_list(arms), curves, report);
      for (std::size_t i = 0; i < curves.size(); ++i)
        chart.series.push_back(
            reference_series(curves[i], compare_arms(as_list(angles), as_list(arms), curves[i]), static_cast<int>(i)));
    }
    tell_by_force(table, muscle.name, arms, report);
    if (const std::string text = doubtful_text(table, muscle.name); !text.empty()) report.lines.push_back(text);
    write_chart(folder / "plots" / ("moment_arms_" + muscle.name + ".svg"), chart);
  }
  write_chart(folder / "plots" / "moment_arms.svg",
              muscles_chart(table, coordinate, muscles, scene.name + ": " + title, y_label));
  if (references.empty()) return report;
  if (comparisons.empty())
    report.warnings.push_back(
        fmt::format("the reference tells nothing of these muscles about {} in this range", moved.name));
  else
    write_text_atomically(folder / "reference.csv",
                          "muscle,source,angles,from_deg,to_deg,rms_mm,largest_mm,slope_mm_per_deg,"
                          "reference_slope_mm_per_deg,beyond_band_mm\n" +
                              comparisons);
  return report;
}

}  // namespace

MomentArmReport write_moment_arms(const std::filesystem::path& folder, const Scene& scene,
                                  const std::vector<MovedCoordinate>& moved, const std::vector<ArmCurve>& references) {
  return moved.size() > 1 ? write_grids(folder, scene, moved) : write_curves(folder, scene, moved.front(), references);
}

}  // namespace gracilis
