#include <gracilis/io/measures_table.hpp>

#include <gracilis/anatomy/joint_pose.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/value_reader.hpp>
#include <gracilis/methods/registry.hpp>

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

namespace gracilis {

std::string measures_header(const Scene& scene) {
  std::string header = "frame,time_s";
  for (const Joint& joint : scene.joints) {
    for (const JointAxis& axis : joint.axes) header += fmt::format(",{}_{}", axis.coordinate, shown_unit(axis));
  }
  header +=
      ",muscle,volume_ratio,edge_ratio_mean,edge_ratio_max,edge_ratio_max_free,dihedral_change_mean_deg,"
      "dihedral_change_max_deg,hinges_over_90,vertex_depth_mm,vertex_depth_beyond_rest_mm,"
      "midpoint_depth_beyond_rest_mm,belly_off_place_mm,wrong_side_share,slack";
  for (const MetricInfo& metric : method_of(scene).metrics) header += fmt::format(",{}", metric.name);
  return header + ",milliseconds,activation,fiber_strain_mean,cross_section_cm2,physiological_cross_section_cm2\n";
}

static std::string measure_cells(const MuscleMeasures& m) {
  return fmt::format(",{:.6f},{:.6f},{:.4f},{:.4f},{:.3f},{:.3f},{},{:.4f},{:.4f},{:.4f},{:.3f},{:.4f},{:.4f}",
                     m.volume_ratio, m.edge_ratio_mean, m.edge_ratio_max, m.edge_ratio_max_free,
                     degrees(m.dihedral_change_mean), degrees(m.dihedral_change_max), m.hinges_over_90,
                     1000 * m.vertex_depth, 1000 * m.vertex_depth_beyond_rest, 1000 * m.midpoint_depth_beyond_rest,
                     1000 * m.belly_off_place, m.wrong_side, m.slack);
}

static std::string report_cells(const MethodEntry& method, const MuscleReport& report) {
  std::string cells;
  for (const MetricInfo& info : method.metrics)
    cells += fmt::format(",{:.{}f}", metric(report.metrics, info.name), info.digits);
  return cells + fmt::format(",{:.3f}", report.milliseconds);
}

/// Activation and fibers; nan where a muscle has no fibers.
static std::string fiber_cells(Real activation, const MuscleFibers& fibers) {
  if (fibers.lengths.empty()) return fmt::format(",{:.4f},nan,nan,nan", activation);
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
    rows += begin + "," + scene.muscles[i].name + measure_cells(measures) + report_cells(method_of(scene), report) +
            fiber_cells(i < activations.size() ? activations[i] : 0, fibers) + "\n";
  }
  return rows;
}

void append_measures(const std::filesystem::path& path, const std::string& header, const std::string& rows) {
  const bool is_new = !std::filesystem::exists(path);
  std::ofstream file(path, std::ios::binary | std::ios::app);
  if (is_new) file << header;
  file << rows;
  file.close();
  if (!file) {
    throw InputError({path.string(), "", std::string("cannot be written: ") + std::strerror(errno),
                      "check the folder's permissions and the free space of the disk"});
  }
}

void truncate_measures(const std::filesystem::path& path, int first_dropped) {
  if (!std::filesystem::exists(path)) return;
  const std::string text = read_text(path);
  std::string kept;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) break;  // a row that an interruption cut off
    const std::string_view line(text.data() + begin, end + 1 - begin);
    long long frame = -1;
    if (!parse_integer(line.substr(0, line.find(',')), frame) || frame < first_dropped) kept += line;
    begin = end + 1;
  }
  write_text_atomically(path, kept);
}

}  // namespace gracilis
