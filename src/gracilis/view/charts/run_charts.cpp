#include <gracilis/view/charts/run_charts.hpp>

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/text_cells.hpp>
#include <gracilis/io/value_reader.hpp>
#include <gracilis/simulate/gates.hpp>
#include <gracilis/view/pictures/muscle_colors.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

namespace fs = std::filesystem;

static std::vector<Real> column(const Table& table, const std::string& name, Real factor) {
  const std::optional<Eigen::Index> found = column_of(table, name);
  if (!found) return {};
  const Eigen::VectorXd values = factor * table.values.col(*found);
  return {values.begin(), values.end()};
}

ChartCoordinate chart_coordinate(const Scene& scene, const std::string& name) {
  for (const Joint& joint : scene.joints)
    for (const JointAxis& axis : joint.axes)
      if (axis.coordinate == name && axis.translation) return {name, 1000, name + " (mm)"};
  return {name, 1, name + " (degrees)"};
}

LineChart fiber_chart(const Table& table, const ChartCoordinate& coordinate, const std::string& muscle,
                      const std::string& title, const std::string& y_label) {
  LineChart chart{title, coordinate.label, y_label, {}};
  const std::vector<Real> x = column(table, coordinate.name, coordinate.factor);
  Index fiber = 0;
  for (const std::string& name : table.columns) {
    if (!name.starts_with(muscle + "_f")) continue;
    // Neighbors in number get different tints, so that lines can be told apart.
    const Real tint = 0.45 + 0.5 * std::fmod(0.618 * fiber++, 1);
    chart.series.push_back({"", x, column(table, name, 1000), Color(0.95 * tint + 0.05, 0.55 * tint, 0.5 * tint), 0.8});
  }
  chart.series.push_back({"mean", x, column(table, muscle, 1000), Color(0.05, 0.05, 0.3), 3});
  return chart;
}

LineChart muscles_chart(const Table& table, const ChartCoordinate& coordinate, const std::vector<std::string>& muscles,
                        const std::string& title, const std::string& y_label) {
  LineChart chart{title, coordinate.label, y_label, {}};
  const std::vector<Real> x = column(table, coordinate.name, coordinate.factor);
  for (const std::string& muscle : muscles) {
    const std::vector<Real> y = column(table, muscle, 1000);
    if (!y.empty()) chart.series.push_back({muscle, x, y, muscle_color(muscle), 2});
  }
  return chart;
}

std::string main_coordinate(const Table& table, const Scene& scene) {
  std::string found;
  Real largest = -1;
  for (const std::string& name : coordinate_names(scene)) {
    const std::vector<Real> values = column(table, name, chart_coordinate(scene, name).factor);
    if (values.empty()) continue;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    if (*high - *low > largest) largest = *high - *low, found = name;
  }
  return found;
}

/// A column of measures.csv as a chart shows it.
struct ShownMeasure {
  std::string_view column;
  Real rest = 0;    ///< what it is where nothing has changed
  Real factor = 1;  ///< of what is above that
  std::string file, title, y_label;
  std::vector<Real> limits = {};  ///< of the gate, as shown
};

/// The column per muscle against the frame.
static LineChart measures_chart(const fs::path& file, const Scene& scene, const ShownMeasure& shown) {
  const std::string text = read_text(file);
  ValueReader reader(file, text);
  const std::vector<std::string_view> names = cells_of(reader.line());
  const auto index_of = [&](std::string_view name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const std::size_t frame = index_of("frame"), muscle = index_of("muscle"), value = index_of(shown.column);
  LineChart chart{scene.name + ": " + shown.title, "frame", shown.y_label, {}, shown.limits};
  for (const Muscle& each : scene.muscles) chart.series.push_back({each.name, {}, {}, muscle_color(each.name), 2});
  while (!reader.at_end()) {
    const std::vector<std::string_view> cells = cells_of(reader.line());
    if (cells.size() <= std::max({frame, muscle, value})) continue;
    double x = 0, y = 0;
    if (!parse_number(cells[frame], x) || !parse_number(cells[value], y)) continue;
    for (ChartSeries& series : chart.series) {
      if (series.name != cells[muscle]) continue;
      series.x.push_back(x);
      series.y.push_back(shown.factor * (y - shown.rest));
    }
  }
  return chart;
}

void write_run_charts(const fs::path& run_folder, const Scene& scene) {
  fs::create_directories(run_folder / "plots");
  const fs::path measures = run_folder / "measures.csv", lengths = run_folder / "fiber_lengths.sto";
  if (fs::exists(measures)) {
    const Real volume = 100 * QualityGates{}.volume;
    const ShownMeasure shown[] = {
        {"volume_ratio", 1, 100, "volume.svg", "volume", "change of volume (%)", {-volume, volume}},
        {"edge_ratio_mean", 1, 100, "edges.svg", "edges", "mean change of edges (%)"},
        {"dihedral_change_mean_deg", 0, 1, "angles.svg", "angles", "mean change of dihedral angles (degrees)"}};
    for (const ShownMeasure& each : shown)
      write_chart(run_folder / "plots" / each.file, measures_chart(measures, scene, each));
  }
  if (!fs::exists(lengths)) return;
  const Table table = read_table(lengths);
  const std::string coordinate = main_coordinate(table, scene);
  if (coordinate.empty()) return;
  for (const Muscle& muscle : scene.muscles) {
    if (!column_of(table, muscle.name)) continue;
    write_chart(run_folder / "plots" / ("fiber_lengths_" + muscle.name + ".svg"),
                fiber_chart(table, chart_coordinate(scene, coordinate), muscle.name, muscle.name + ": fiber lengths",
                            "length (mm)"));
  }
}

}  // namespace gracilis
