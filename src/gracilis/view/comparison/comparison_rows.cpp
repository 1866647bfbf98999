#include <gracilis/view/comparison/comparison_rows.hpp>

#include <gracilis/dynamics/contact/self/self_intersections.hpp>
#include <gracilis/io/tables/table.hpp>
#include <gracilis/simulate/moment_arms.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace gracilis {

namespace {

constexpr Real unknown = std::numeric_limits<Real>::quiet_NaN();

/// The frame at which the main coordinate is farthest from that of frame 0.
int farthest_frame(const RecordedRun& run) {
  const int coordinate = main_coordinate(run);
  if (coordinate < 0 || run.frame_count == 0) return 0;
  Eigen::Index frame = 0;
  (run.coordinate_values.col(coordinate).array() - run.coordinate_values(0, coordinate)).abs().maxCoeff(&frame);
  return static_cast<int>(frame);
}

/// The largest value of a muscle's measure over all frames after the capture pose.
Real largest(const RecordedRun& run, const std::string& measure, Index muscle, Real reference = 0) {
  const Eigen::MatrixXd values = measure_of(run, measure);
  if (values.size() == 0) return unknown;
  Real result = 0;
  for (Eigen::Index f = 0; f < values.rows(); ++f) {
    const Real value = std::abs(values(f, muscle) - reference);
    if (!std::isfinite(value)) return unknown;
    result = std::max(result, value);
  }
  return result;
}

Real mean_milliseconds(const RecordedRun& run, Index muscle) {
  const Eigen::MatrixXd values = measure_of(run, "milliseconds");
  return values.rows() > 1 ? values.col(muscle).tail(values.rows() - 1).mean() : unknown;
}

Real cuts_in(const RecordedRun& run, const std::string& muscle, const std::vector<int>& frames) {
  const TriangleMesh rest = recorded_surface(run, muscle, 0);
  Index most = 0;
  for (const int frame : frames)
    most = std::max(most, new_self_intersections(rest, recorded_surface(run, muscle, frame).vertices));
  return most;
}

}  // namespace

const std::vector<ComparisonColumn>& comparison_columns() {
  static const std::vector<ComparisonColumn> columns = {
      {"frames", "Frames", 0},
      {"mean_ms", "Time per frame, ms", 2, true},
      {"volume_error_percent", "Largest error of volume, %", 3, true},
      {"edge_change_percent", "Largest mean change of edges, %", 2, true},
      {"longest_free_edge", "Longest edge away from attachments, × rest", 2, true},
      {"dihedral_change_deg", "Largest mean change of dihedral angles, °", 2, true},
      {"hinges_over_90", "Most dihedrals turned by more than 90°", 0, true},
      {"vertex_depth_mm", "Deepest vertex in a bone, beyond rest, mm", 3, true},
      {"midpoint_depth_mm", "Deepest edge midpoint in a bone, beyond rest, mm", 3, true},
      {"self_cuts", "Pairs of triangles that cut each other, in the frames shown", 0, true},
      {"fiber_length_mm", "Mean fiber length in the farthest pose, mm", 1},
      {"fiber_change_percent", "Its change from the capture pose, %", 1},
      {"moment_arm_mm", "Mean moment arm half way, mm", 1}};
  return columns;
}

Index new_self_intersections(const TriangleMesh& rest, const Points& now) {
  const Vec3 middle = now.rowwise().mean();
  const Eigen::VectorXd weights = Eigen::VectorXd::Ones(now.cols());
  const Points near = rest.vertices.colwise() - rest.vertices.rowwise().mean();
  const Particles at_rest = make_particles(near, weights);
  const Particles particles = make_particles(now.colwise() - middle, weights);
  std::vector<Index> faces(static_cast<std::size_t>(rest.face_count()));
  std::iota(faces.begin(), faces.end(), Index{0});
  const ContactSurface surface = build_contact_surface(rest.faces, rest.vertex_count());
  const Eigen::Matrix3Xf rest_points = near.cast<float>();
  return static_cast<Index>(find_self_intersections(surface, rest_points, at_rest, particles, std::move(faces)).size());
}

FiberCourse fiber_course(const RecordedRun& run, const std::string& muscle) {
  FiberCourse course;
  const int coordinate = main_coordinate(run), last = farthest_frame(run);
  const std::filesystem::path file = run.folder / "fiber_lengths.sto";
  if (coordinate < 0 || last == 0 || !std::filesystem::exists(file)) return course;
  const Table table = read_table(file);
  const std::optional<Eigen::Index> column = column_of(table, muscle);
  if (!column || table.values.rows() <= last) return course;
  const Eigen::VectorXd along = run.coordinate_values.col(coordinate);
  const bool grows = along[last] > along[0];
  int first = last;
  while (first > 0 && (grows ? along[first - 1] < along[first] : along[first - 1] > along[first])) --first;
  const bool is_angle = coordinate_label(run.coordinates[static_cast<std::size_t>(coordinate)]).unit == "°";
  const Eigen::VectorXd shown = along.segment(first, last - first + 1);
  const Eigen::VectorXd si = shown * (is_angle ? pi / 180 : 0.001);
  const Eigen::VectorXd lengths = table.values.col(*column).segment(first, last - first + 1);
  const Eigen::VectorXd arms = moment_arms(si, lengths);
  course.coordinate.assign(shown.begin(), shown.end());
  course.length.assign(lengths.begin(), lengths.end());
  course.moment_arm.assign(arms.begin(), arms.end());
  return course;
}

std::vector<ComparisonRow> comparison_rows(const std::vector<ComparedRun>& runs, const std::vector<int>& frames) {
  std::vector<ComparisonRow> rows;
  for (const ComparedRun& compared : runs) {
    const RecordedRun& run = compared.run;
    std::vector<int> looked_at;
    for (const int frame : frames) looked_at.push_back(nearest_pose(runs[0].run, frame, run));
    for (Index m = 0; m < static_cast<Index>(run.muscles.size()); ++m) {
      const std::string& muscle = run.muscles[static_cast<std::size_t>(m)];
      const FiberCourse fibers = fiber_course(run, muscle);
      const bool has_fibers = !fibers.length.empty();
      rows.push_back(
          {compared.method,
           muscle,
           {static_cast<Real>(run.frame_count), mean_milliseconds(run, m), 100 * largest(run, "volume_ratio", m, 1),
            100 * largest(run, "edge_ratio_mean", m, 1), largest(run, "edge_ratio_max_free", m),
            largest(run, "dihedral_change_mean_deg", m), largest(run, "hinges_over_90", m),
            largest(run, "vertex_depth_beyond_rest_mm", m), largest(run, "midpoint_depth_beyond_rest_mm", m),
            cuts_in(run, muscle, looked_at), has_fibers ? 1000 * fibers.length.back() : unknown,
            has_fibers ? 100 * (fibers.length.back() / fibers.length.front() - 1) : unknown,
            has_fibers ? 1000 * fibers.moment_arm[fibers.moment_arm.size() / 2] : unknown}});
    }
  }
  return rows;
}

std::string comparison_csv(const std::vector<ComparisonRow>& rows) {
  std::string text = "method,muscle";
  for (const ComparisonColumn& column : comparison_columns()) text += fmt::format(",{}", column.key);
  text += '\n';
  for (const ComparisonRow& row : rows) {
    text += row.method + "," + row.muscle;
    for (std::size_t c = 0; c < row.values.size(); ++c)
      text +=
          std::isfinite(row.values[c]) ? fmt::format(",{:.{}f}", row.values[c], comparison_columns()[c].digits) : ",";
    text += '\n';
  }
  return text;
}

}  // namespace gracilis
