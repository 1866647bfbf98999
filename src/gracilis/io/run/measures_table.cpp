#include <gracilis/io/run/measures_table.hpp>

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/csv_rows.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/value_reader.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/scene/names.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>
#include <type_traits>
#include <variant>

namespace gracilis {

/// Where the columns of the method end. It is never empty: readers drop empty cells at the end of a line.
static constexpr std::string_view first_column_after_method = "milliseconds";

std::string measures_header(const Scene& scene) {
  std::string header = "frame,time_s";
  for (const Joint& joint : scene.joints) {
    for (const JointAxis& axis : joint.axes) header += fmt::format(",{}_{}", axis.coordinate, shown_unit(axis));
  }
  header += ",muscle";
  for (const std::string& column : measure_columns()) {
    if (column == first_column_after_method)
      for (const MetricInfo& metric : method_of(scene).metrics) header += fmt::format(",{}", metric.name);
    header += "," + column;
  }
  return header + "\n";
}

/// A measure as the table has it.
struct MeasureColumn {
  std::variant<Real MuscleMeasures::*, Index MuscleMeasures::*> measure;
  MeasureLevel level;  ///< the least that measures it
  int digits = 0;      ///< after the point
  Real units = 1;      ///< of the table, in one of ours
};

/// The first of measure_columns(), in their order.
static const std::vector<MeasureColumn>& columns_of_measures() {
  using M = MuscleMeasures;
  using enum MeasureLevel;
  static const std::vector<MeasureColumn> columns = {{&M::volume_ratio, light, 6},
                                                     {&M::edge_ratio_mean, light, 6},
                                                     {&M::edge_ratio_max, light, 4},
                                                     {&M::edge_ratio_max_free, light, 4},
                                                     {&M::edge_ratio_max_near, light, 4},
                                                     {&M::spike, light, 3},
                                                     {&M::thickening, light, 3},
                                                     {&M::thinning, light, 3},
                                                     {&M::dihedral_change_mean, light, 3, degrees(1)},
                                                     {&M::dihedral_change_max, light, 3, degrees(1)},
                                                     {&M::dihedrals_over_90, light},
                                                     {&M::vertex_depth, full, 4, 1000},
                                                     {&M::vertex_depth_beyond_rest, full, 4, 1000},
                                                     {&M::midpoint_depth_beyond_rest, full, 4, 1000},
                                                     {&M::muscle_depth_beyond_rest, full, 4, 1000},
                                                     {&M::belly_off_place, full, 3, 1000},
                                                     {&M::wrong_side, full, 4},
                                                     {&M::slack, full, 4}};
  return columns;
}

/// Empty where a level does not measure it.
static std::string measure_cells(const MuscleMeasures& measures) {
  std::string cells;
  for (const MeasureColumn& column : columns_of_measures()) {
    cells += ',';
    if (measures.level < column.level) continue;
    std::visit(
        [&](auto member) { cells += fmt::format("{:.{}f}", Real(measures.*member) * column.units, column.digits); },
        column.measure);
  }
  return cells;
}

static std::string report_cells(const MethodEntry& method, const MuscleReport& report) {
  std::string cells;
  for (const MetricInfo& info : method.metrics)
    cells += fmt::format(",{:.{}f}", metric(report.metrics, info.name), info.digits);
  return cells + fmt::format(",{:.3f}", report.milliseconds);
}

/// Activation and fibers; empty where a muscle has no fibers.
static std::string fiber_cells(Real activation, const MuscleFibers& fibers) {
  if (fibers.lengths.empty()) return fmt::format(",{:.4f},,,", activation);
  return fmt::format(",{:.4f},{:.6f},{:.4f},{:.4f}", activation, fibers.mean_strain, 1e4 * fibers.cross_section,
                     1e4 * fibers.physiological_cross_section);
}

/// Number, time and coordinates of a frame, with which its rows begin.
static std::string frame_cells(const Scene& scene, int number, const Pose& pose) {
  std::string cells = fmt::format("{},{:.6f}", number, pose.time);
  std::size_t coordinate = 0;
  for (const Joint& joint : scene.joints)
    for (const JointAxis& axis : joint.axes)
      cells += fmt::format(",{:.4f}", shown_value(axis, pose.coordinates[coordinate++]));
  return cells + ",";
}

std::string measures_rows(const Scene& scene, const FrameRecord& record) {
  const std::string begin = frame_cells(scene, record.frame.number, record.frame.pose);
  std::string rows;
  for (std::size_t i = 0; i < scene.muscles.size(); ++i) {
    const MuscleMeasures measures = i < record.measures.size() ? record.measures[i] : MuscleMeasures{};
    const MuscleReport report = i < record.report.muscles.size() ? record.report.muscles[i] : MuscleReport{};
    const MuscleFibers fibers = i < record.fibers.size() ? record.fibers[i] : MuscleFibers{};
    const std::vector<Real>& activations = record.frame.pose.activations;
    rows += begin + scene.muscles[i].name + measure_cells(measures) +
            fiber_cells(i < activations.size() ? activations[i] : 0, fibers) + report_cells(method_of(scene), report) +
            "\n";
  }
  return rows;
}

/// The cells of one row that are measures.
static MuscleMeasures measures_in(const CsvRows& rows) {
  MuscleMeasures measures;
  measures.level = MeasureLevel::none;
  for (std::size_t i = 0; i < columns_of_measures().size(); ++i) {
    const std::size_t cell = rows.column(measure_columns()[i]).value();
    if (rows.cell(cell).empty()) continue;
    const MeasureColumn& column = columns_of_measures()[i];
    const Real value = rows.number(cell, "a number") / column.units;
    std::visit([&](auto member) { measures.*member = static_cast<std::decay_t<decltype(measures.*member)>>(value); },
               column.measure);
    measures.level = std::max(measures.level, column.level);
  }
  return measures;
}

void read_measures(const std::filesystem::path& path, const Scene& scene, int end,
                   const std::function<void(const FrameRecord&)>& act) {
  const std::string text = read_text(path);
  CsvRows rows(path, text);
  FrameRecord record;
  while (rows.next()) {
    Index frame = 0;
    if (!parse_index(rows.cell(0), frame)) rows.fail("holds no number of a frame", "replace the run with --force");
    if (frame >= end) break;
    record.frame.number = frame;
    record.measures.push_back(measures_in(rows));
    record.report.muscles.emplace_back();
    for (const MetricInfo& metric : method_of(scene).metrics)
      record.report.muscles.back().metrics.push_back(
          {metric.name, rows.number(rows.column(metric.name).value(), "a number")});
    if (record.measures.size() < scene.muscles.size()) continue;
    act(record);
    record = {};
  }
}

void append_measures(const std::filesystem::path& path, const std::string& header, const std::string& rows) {
  std::ofstream file(path, std::ios::binary | std::ios::app);
  file.seekp(0, std::ios::end);
  if (file.tellp() == std::streampos(0)) file << header;
  file << rows;
  file.close();
  if (!file) {
    throw InputError({path.string(), "", std::string("cannot be written: ") + std::strerror(errno),
                      "check the folder's permissions and the free space of the disk"});
  }
}

void require_same_columns(const std::filesystem::path& path, const std::string& header) {
  const std::string text = text_if_there(path);
  const std::size_t end = text.find('\n');
  if (end == std::string::npos || std::string_view(text).substr(0, end + 1) == header) return;
  throw InputError({path.string(), "1", "has other columns than a run of this scene by this version",
                    "resume with the scene and the version that began it, or replace the run with --force"});
}

/// Calls act(line, row) for each row, the header among them, with its end; not for one that an interruption cut off.
template <class Act>
static void for_each_row(std::string_view text, const Act& act) {
  std::size_t begin = 0;
  for (int line = 1;; ++line) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos) return;
    act(line, text.substr(begin, end + 1 - begin));
    begin = end + 1;
  }
}

/// Whether a row is of a frame before `end`, and which.
static bool is_before(std::string_view row, int end, Index& frame) {
  return parse_index(row.substr(0, row.find(',')), frame) && frame < end;
}

void require_same_poses(const std::filesystem::path& path, const Scene& scene, const std::vector<Pose>& poses,
                        int end) {
  for_each_row(text_if_there(path), [&](int line, std::string_view row) {
    Index frame = 0;
    if (!is_before(row, end, frame)) return;
    if (row.starts_with(frame_cells(scene, frame, poses[static_cast<std::size_t>(frame)]))) return;
    throw InputError({path.string(), std::to_string(line), fmt::format("frame {} is of another motion", frame),
                      "resume with the motion that the run was begun with, or replace the run with --force"});
  });
}

void truncate_measures(const std::filesystem::path& path, int first_dropped) {
  if (!is_there(path)) return;
  std::string kept;
  for_each_row(text_if_there(path), [&](int line, std::string_view row) {
    Index frame = 0;
    if (line == 1 || is_before(row, first_dropped, frame)) kept += row;
  });
  write_text_atomically(path, kept);
}

}  // namespace gracilis
