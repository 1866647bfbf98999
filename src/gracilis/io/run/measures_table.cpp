#include <gracilis/io/run/measures_table.hpp>

#include <gracilis/anatomy/joints/joint_pose.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/value_reader.hpp>
#include <gracilis/methods/registry.hpp>
#include <gracilis/scene/names.hpp>

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>

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

/// Empty where a level does not measure it.
static std::string measure_cells(const MuscleMeasures& m) {
  if (m.level == MeasureLevel::none) return ",,,,,,,,,,,,,,,,,,";
  const std::string shape = fmt::format(
      ",{:.6f},{:.6f},{:.4f},{:.4f},{:.4f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{}", m.volume_ratio, m.edge_ratio_mean,
      m.edge_ratio_max, m.edge_ratio_max_free, m.edge_ratio_max_near, m.spike, m.thickening, m.thinning,
      degrees(m.dihedral_change_mean), degrees(m.dihedral_change_max), m.dihedrals_over_90);
  if (m.level == MeasureLevel::light) return shape + ",,,,,,,";
  return shape + fmt::format(",{:.4f},{:.4f},{:.4f},{:.4f},{:.3f},{:.4f},{:.4f}", 1000 * m.vertex_depth,
                             1000 * m.vertex_depth_beyond_rest, 1000 * m.midpoint_depth_beyond_rest,
                             1000 * m.muscle_depth_beyond_rest, 1000 * m.belly_off_place, m.wrong_side, m.slack);
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

std::string measures_rows(const Scene& scene, const FrameRecord& record) {
  std::string begin = fmt::format("{},{:.6f}", record.frame.number, record.frame.pose.time);
  std::size_t coordinate = 0;
  for (const Joint& joint : scene.joints)
    for (const JointAxis& axis : joint.axes)
      begin += fmt::format(",{:.4f}", shown_value(axis, record.frame.pose.coordinates[coordinate++]));
  std::string rows;
  for (std::size_t i = 0; i < scene.muscles.size(); ++i) {
    const MuscleMeasures measures = i < record.measures.size() ? record.measures[i] : MuscleMeasures{};
    const MuscleReport report = i < record.report.muscles.size() ? record.report.muscles[i] : MuscleReport{};
    const MuscleFibers fibers = i < record.fibers.size() ? record.fibers[i] : MuscleFibers{};
    const std::vector<Real>& activations = record.frame.pose.activations;
    rows += begin + "," + scene.muscles[i].name + measure_cells(measures) +
            fiber_cells(i < activations.size() ? activations[i] : 0, fibers) + report_cells(method_of(scene), report) +
            "\n";
  }
  return rows;
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

void truncate_measures(const std::filesystem::path& path, int first_dropped) {
  if (!is_there(path)) return;
  const std::string text = text_if_there(path);
  std::string kept;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) break;  // a row that an interruption cut off
    const std::string_view line(text.data() + begin, end + 1 - begin);
    Index frame = 0;
    const bool is_head = begin == 0;
    if (is_head || (parse_index(line.substr(0, line.find(',')), frame) && frame < first_dropped)) kept += line;
    begin = end + 1;
  }
  write_text_atomically(path, kept);
}

}  // namespace gracilis
