#include <gracilis/view/report/report_data.hpp>

#include <gracilis/io/tables/force_table.hpp>
#include <gracilis/io/tables/table.hpp>
#include <gracilis/io/value_reader.hpp>
#include <gracilis/simulate/measures.hpp>
#include <gracilis/view/pictures/muscle_colors.hpp>
#include <gracilis/view/pictures/pose_caption.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace gracilis {

using Json = nlohmann::ordered_json;

namespace {

/// A measure as the report shows it: shown = factor (value - reference).
struct ShownMeasure {
  const char* measure;
  const char* title;
  const char* unit;
  Real reference, factor;
  std::vector<Real> limits;  ///< of the shown value
};

std::vector<ShownMeasure> shown_measures() {
  const QualityGates gates;
  return {
      {"volume_ratio", "Change of volume", "%", 1, 100, {-100 * gates.volume, 100 * gates.volume}},
      {"edge_ratio_mean", "Mean change of edge length", "%", 1, 100, {}},
      {"edge_ratio_max_free", "Longest edge away from attachments", "× rest", 0, 1, {gates.free_edge_ratio}},
      {"edge_ratio_max_near", "Longest edge near attachments", "× rest", 0, 1, {gates.near_edge_ratio}},
      {"spike", "Largest spike", "edges", 0, 1, {gates.spike}},
      {"thickening", "Thickest place", "× rest", 0, 1, {gates.thickening}},
      {"thinning", "Thinnest place, rest over now", "×", 0, 1, {gates.thinning}},
      {"dihedral_change_mean_deg", "Mean change of dihedral angles", "°", 0, 1, {}},
      {"hinges_over_90", "Dihedrals turned by more than 90°", "", 0, 1, {}},
      {"vertex_depth_beyond_rest_mm", "Deepest vertex in a bone, beyond rest", "mm", 0, 1, {1000 * gates.vertex_depth}},
      {"midpoint_depth_beyond_rest_mm",
       "Deepest edge midpoint in a bone, beyond rest",
       "mm",
       0,
       1,
       {1000 * gates.midpoint_depth}},
      {"muscle_depth_beyond_rest_mm",
       "Deepest vertex in another muscle, beyond rest",
       "mm",
       0,
       1,
       {1000 * gates.muscle_depth}},
      {"belly_off_place_mm", "Belly off its place", "mm", 0, 1, {1000 * gates.belly_off_place}},
      {"wrong_side_share", "Lines on the wrong side of a bone", "%", 0, 100, {100 * gates.wrong_side}},
      {"slack", "Lines longer than taut", "%", 0, 100, {100 * gates.slack}},
      {"activation", "Activation", "", 0, 1, {}},
      {"physiological_cross_section_cm2", "Physiological cross-section", "cm²", 0, 1, {}},
      {"milliseconds", "Time per frame", "ms", 0, 1, {}}};
}

}  // namespace

/// Rounded to what can be seen, so that the file stays small.
static Json rounded(Real value) {
  if (!std::isfinite(value)) return nullptr;
  double seen = 0;
  // The largest and the least of all numbers have no neighbor of five digits; they stay as they are.
  return value == 0 || parse_number(fmt::format("{:.5g}", value), seen) ? seen : value;
}

static Json rounded(const Eigen::VectorXd& values) {
  Json list = Json::array();
  for (const Real value : values) list.push_back(rounded(value));
  return list;
}

/// Whether a run took this measure at all; a full one did, whatever came out.
static bool is_measured(const RecordedRun& run, const Eigen::MatrixXd& values) {
  return run.manifest.value("metrics", "full") == "full" || !values.array().isNaN().all();
}

static Json measure_chart(const RecordedRun& run, const ShownMeasure& shown) {
  const Eigen::MatrixXd values = measure_of(run, shown.measure);
  if (!is_measured(run, values)) return nullptr;
  Json chart = {{"id", shown.measure}, {"title", shown.title}, {"unit", shown.unit}, {"limits", shown.limits}};
  Json series = Json::array();
  bool any = false;
  for (Index m = 0; m < values.cols(); ++m) {
    const Eigen::VectorXd y = shown.factor * (values.col(m).array() - shown.reference);
    any = any || (y.array().isFinite() && y.array() != 0).any();
    series.push_back({{"muscle", run.muscles[static_cast<std::size_t>(m)]}, {"values", rounded(y)}});
  }
  chart["series"] = series;
  // Where nothing ever happens there is nothing to see; a gate that is met by far is worth seeing.
  return any || !shown.limits.empty() ? chart : Json(nullptr);
}

/// The columns of a table over the frames; it may hold the last frames only.
static Json table_chart(const RecordedRun& run, const std::string& file, const std::string& id,
                        const std::string& title) {
  if (!std::filesystem::exists(run.folder / file)) return nullptr;
  const Table table = read_table(run.folder / file);
  const auto rows = std::min<Eigen::Index>(table.values.rows(), run.frame_count);
  Json series = Json::array();
  for (const std::string& muscle : run.muscles) {
    const std::optional<Eigen::Index> mean = column_of(table, muscle);
    if (!mean) continue;
    Eigen::VectorXd values = Eigen::VectorXd::Constant(run.frame_count, std::nan("")), low = values, high = values;
    values.tail(rows) = 1000 * table.values.col(*mean).head(rows);
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      if (!table.columns[c].starts_with(muscle + "_f")) continue;
      const Eigen::VectorXd fiber = 1000 * table.values.col(static_cast<Index>(c)).head(rows);
      low.tail(rows) = low.tail(rows).binaryExpr(fiber, [](Real a, Real b) { return std::fmin(a, b); });
      high.tail(rows) = high.tail(rows).binaryExpr(fiber, [](Real a, Real b) { return std::fmax(a, b); });
    }
    Json each = {{"muscle", muscle}, {"values", rounded(values)}};
    if (!low.array().isNaN().all()) each["low"] = rounded(low), each["high"] = rounded(high);
    series.push_back(each);
  }
  if (series.empty()) return nullptr;
  return {{"id", id}, {"title", title}, {"unit", "mm"}, {"limits", Json::array()}, {"series", series}};
}

/// Forces as the run wrote them: tensions of whole muscles, and what these do about each coordinate.
static std::vector<Json> force_charts(const RecordedRun& run) {
  if (!std::filesystem::exists(run.folder / force_file)) return {};
  const Table table = read_table(run.folder / force_file);
  const auto rows = std::min<Eigen::Index>(table.values.rows(), run.frame_count);
  const auto chart = [&](const std::string& id, const std::string& title, const std::string& unit) {
    Json series = Json::array();
    for (const std::string& muscle : run.muscles) {
      const std::optional<Eigen::Index> column = column_of(table, muscle + "_" + id);
      if (!column) continue;
      Eigen::VectorXd values = Eigen::VectorXd::Constant(run.frame_count, std::nan(""));
      values.tail(rows) = table.values.col(*column).head(rows);
      series.push_back({{"muscle", muscle}, {"values", rounded(values)}});
    }
    return Json{{"id", id}, {"title", title}, {"unit", unit}, {"limits", Json::array()}, {"series", series}};
  };
  std::vector<Json> charts = {chart("tension", "Tension of all fibers", "N")};
  for (const std::string& column : run.coordinates) {
    const CoordinateLabel label = coordinate_label(column);
    const Json each = chart("moment_" + label.name, "Moment about " + label.name, label.unit == "°" ? "N·m" : "N");
    if (!each["series"].empty()) charts.push_back(each);
  }
  return charts;
}

static Json charts_of(const RecordedRun& run) {
  Json charts = Json::array();
  const auto add = [&](const Json& chart) {
    if (!chart.is_null()) charts.push_back(chart);
  };
  add(table_chart(run, "fiber_lengths.sto", "fiber_lengths", "Fiber length, mean (band: shortest to longest)"));
  add(table_chart(run, "moment_arms.sto", "moment_arms", "Moment arm, mean (band: least to greatest)"));
  for (const Json& chart : force_charts(run)) add(chart);
  for (const ShownMeasure& shown : shown_measures()) add(measure_chart(run, shown));
  return charts;
}

static Json gate_of(const RecordedRun& run, const ShownMeasure& shown, Index muscle) {
  const Real limit = shown.limits.back();
  const Eigen::MatrixXd all = measure_of(run, shown.measure);
  Json gate = {{"muscle", run.muscles[static_cast<std::size_t>(muscle)]},
               {"measure", shown.measure},
               {"title", shown.title},
               {"unit", shown.unit},
               {"limit", rounded(limit)},
               {"both_ways", shown.limits.size() > 1}};
  if (all.size() == 0) return nullptr;
  gate["measured"] = is_measured(run, all);
  if (!gate["measured"]) return gate;
  const Eigen::VectorXd values = shown.factor * (all.col(muscle).array() - shown.reference);
  Index worst = 0;
  int missed = 0;
  for (Index f = 0; f < values.size(); ++f) {
    const Real size = gate["both_ways"] ? std::abs(values[f]) : values[f];
    const Real sofar = gate["both_ways"] ? std::abs(values[worst]) : values[worst];
    if (!(size <= sofar) && std::isfinite(sofar)) worst = f;  // what is not finite is worst
    if (!(size <= limit)) ++missed;
  }
  gate["worst"] = rounded(values[worst]);
  gate["frame"] = worst;
  gate["missed"] = missed;
  gate["met"] = missed == 0;
  return gate;
}

static Json gates_of(const RecordedRun& run) {
  Json gates = Json::array();
  for (Index m = 0; m < static_cast<Index>(run.muscles.size()); ++m) {
    for (const ShownMeasure& shown : shown_measures()) {
      if (shown.limits.empty()) continue;
      const Json gate = gate_of(run, shown, m);
      if (!gate.is_null()) gates.push_back(gate);
    }
  }
  return gates;
}

static Json coordinates_of(const RecordedRun& run) {
  Json coordinates = Json::array();
  for (std::size_t i = 0; i < run.coordinates.size(); ++i) {
    const CoordinateLabel label = coordinate_label(run.coordinates[i]);
    coordinates.push_back({{"name", label.name},
                           {"unit", label.unit},
                           {"values", rounded(run.coordinate_values.col(static_cast<Index>(i)))}});
  }
  return coordinates;
}

/// What captions call each frame.
static Json poses_of(const RecordedRun& run) {
  Json poses = Json::array();
  const CaptionedFrames frames = captioned_frames(run);
  for (int frame = 0; frame < run.frame_count; ++frame) poses.push_back(pose_words(frames, frame));
  return poses;
}

Json report_data(const RecordedRun& run) {
  Json muscles = Json::array();
  for (const std::string& muscle : run.muscles) {
    const Color color = 255 * muscle_color(muscle);
    muscles.push_back({{"name", muscle},
                       {"color", fmt::format("#{:02x}{:02x}{:02x}", std::lround(color.x()), std::lround(color.y()),
                                             std::lround(color.z()))}});
  }
  const auto vector = [](const Vec3& v) { return Json{v.x(), v.y(), v.z()}; };
  return {{"name", run.manifest.value("scene", run.folder.filename().string())},
          {"folder", run.folder.string()},
          {"manifest", run.manifest},
          {"frame_count", run.frame_count},
          {"times", rounded(Eigen::Map<const Eigen::VectorXd>(run.times.data(), run.frame_count))},
          {"coordinates", coordinates_of(run)},
          {"poses", poses_of(run)},
          {"anterior", vector(run.axes.anterior)},
          {"superior", vector(run.axes.superior)},
          {"right", vector(run.axes.right())},
          {"muscles", muscles},
          {"charts", charts_of(run)},
          {"gates", gates_of(run)}};
}

}  // namespace gracilis
