#include <gracilis/io/recorded_run.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/io/fiber_table.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/mesh_reader.hpp>
#include <gracilis/io/mesh_reader_vtp.hpp>
#include <gracilis/io/polyline_file.hpp>
#include <gracilis/io/run_folder.hpp>
#include <gracilis/io/text_cells.hpp>
#include <gracilis/io/value_reader.hpp>
#include <gracilis/scene/scene_place.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gracilis {

namespace fs = std::filesystem;

static nlohmann::ordered_json read_manifest(const fs::path& folder) {
  const fs::path path = folder / "run.json";
  if (!fs::exists(path))
    throw InputError({folder.string(), "", "is no run folder: it has no run.json", "name the folder of a run"});
  try {
    return nlohmann::ordered_json::parse(read_text(path));
  } catch (const nlohmann::json::exception& error) {
    throw InputError({path.string(), "", std::string("is not JSON: ") + error.what(), "run the scene again"});
  }
}

static AnatomicalAxes axes_of(const nlohmann::ordered_json& manifest) {
  const auto vector = [](const nlohmann::ordered_json& json, const Vec3& otherwise) {
    if (!json.is_array() || json.size() != 3) return otherwise;
    for (const auto& number : json)
      if (!number.is_number()) return otherwise;
    return Vec3(json[0].get<Real>(), json[1].get<Real>(), json[2].get<Real>());
  };
  AnatomicalAxes axes;
  const auto found = manifest.find("axes");
  if (found == manifest.end() || !found->is_object()) return axes;
  axes.anterior = vector(found->value("anterior", nlohmann::ordered_json()), axes.anterior);
  axes.superior = vector(found->value("superior", nlohmann::ordered_json()), axes.superior);
  return axes;
}

namespace {

/// One row of measures.csv.
struct Row {
  int frame = 0;
  std::size_t muscle = 0;
  std::vector<Real> before, after;  ///< the muscle's column: time and coordinates; measures
};

}  // namespace

static Real number_or_nan(std::string_view cell) {
  double value = 0;
  return parse_number(cell, value) ? value : std::numeric_limits<Real>::quiet_NaN();
}

/// Fills everything that stands in measures.csv. Rows that an interruption cut off are left out.
static void read_measures(const fs::path& path, RecordedRun& run) {
  const std::string text = read_text(path);
  ValueReader reader(path, text);
  const std::string head(reader.line());
  const std::vector<std::string_view> columns = cells_of(head);
  const auto muscle_at =
      static_cast<std::size_t>(std::find(columns.begin(), columns.end(), "muscle") - columns.begin());
  if (muscle_at < 2 || muscle_at + 1 >= columns.size() || columns[0] != "frame")
    reader.fail("does not begin with frame, time, coordinates and muscle", "run the scene again");
  run.coordinates.assign(columns.begin() + 2, columns.begin() + static_cast<std::ptrdiff_t>(muscle_at));
  run.measures.assign(columns.begin() + static_cast<std::ptrdiff_t>(muscle_at) + 1, columns.end());

  std::vector<Row> rows;
  while (!reader.at_end()) {
    const std::vector<std::string_view> cells = cells_of(reader.line());
    long long frame = 0;
    if (cells.size() != columns.size() || !parse_integer(cells[0], frame) || frame < 0) continue;
    Row row;
    row.frame = static_cast<int>(frame);
    const auto name = std::find(run.muscles.begin(), run.muscles.end(), cells[muscle_at]);
    row.muscle = static_cast<std::size_t>(name - run.muscles.begin());
    if (name == run.muscles.end()) run.muscles.emplace_back(cells[muscle_at]);
    for (std::size_t i = 1; i < muscle_at; ++i) row.before.push_back(number_or_nan(cells[i]));
    for (std::size_t i = muscle_at + 1; i < cells.size(); ++i) row.after.push_back(number_or_nan(cells[i]));
    run.frame_count = std::max(run.frame_count, row.frame + 1);
    rows.push_back(std::move(row));
  }
  if (rows.empty()) reader.fail("holds no frame", "run the scene again");
  if (rows.size() != static_cast<std::size_t>(run.frame_count) * run.muscles.size())
    reader.fail("does not have one row per frame and muscle", "run the scene again");

  const auto frames = static_cast<std::size_t>(run.frame_count);
  run.times.resize(frames);
  run.coordinate_values.resize(run.frame_count, static_cast<Index>(run.coordinates.size()));
  run.values.assign(run.measures.size(), Eigen::MatrixXd(run.frame_count, static_cast<Index>(run.muscles.size())));
  for (const Row& row : rows) {
    run.times[static_cast<std::size_t>(row.frame)] = row.before[0];
    for (std::size_t i = 1; i < row.before.size(); ++i)
      run.coordinate_values(row.frame, static_cast<Index>(i) - 1) = row.before[i];
    for (std::size_t i = 0; i < row.after.size(); ++i)
      run.values[i](row.frame, static_cast<Index>(row.muscle)) = row.after[i];
  }
}

static void find_surfaces(RecordedRun& run) {
  const std::string end = "_0000.vtp";
  if (!fs::is_directory(run.folder / "frames"))
    throw InputError({run.folder.string(), "", "has no folder 'frames'", "run the scene again"});
  for (const fs::directory_entry& entry : fs::directory_iterator(run.folder / "frames")) {
    const std::string file = entry.path().filename().string();
    if (file.front() == '.' || !file.ends_with(end)) continue;
    const std::string name = file.substr(0, file.size() - end.size());
    if (std::find(run.muscles.begin(), run.muscles.end(), name) == run.muscles.end()) run.bones.push_back(name);
  }
  std::sort(run.bones.begin(), run.bones.end());
  std::vector<std::string> names = run.muscles;
  names.insert(names.end(), run.bones.begin(), run.bones.end());
  int complete = 0;
  const auto is_there = [&](const std::string& name) { return fs::exists(frame_file(run.folder, name, complete)); };
  while (complete < run.frame_count && std::all_of(names.begin(), names.end(), is_there)) ++complete;
  if (complete == 0) throw InputError({run.folder.string(), "", "holds no complete frame", "run the scene again"});
  run.frame_count = complete;
  run.times.resize(static_cast<std::size_t>(complete));
  run.coordinate_values.conservativeResize(complete, Eigen::NoChange);
  for (Eigen::MatrixXd& values : run.values) values.conservativeResize(complete, Eigen::NoChange);
}

RecordedRun open_recorded_run(const fs::path& folder) {
  RecordedRun run;
  run.folder = folder;
  run.manifest = read_manifest(folder);
  run.axes = axes_of(run.manifest);
  read_measures(folder / "measures.csv", run);
  find_surfaces(run);
  run.place = place_of(bounding_box(recorded_surface(run, run.muscles.front(), 0).vertices));
  return run;
}

Eigen::MatrixXd measure_of(const RecordedRun& run, const std::string& measure) {
  const auto found = std::find(run.measures.begin(), run.measures.end(), measure);
  if (found == run.measures.end()) return {};
  return run.values[static_cast<std::size_t>(found - run.measures.begin())];
}

TriangleMesh recorded_surface(const RecordedRun& run, const std::string& name, int frame) {
  return read_mesh(frame_file(run.folder, name, frame), 1);
}

Polylines recorded_fibers(const RecordedRun& run, const std::string& muscle, int frame) {
  const fs::path path = fiber_file(run.folder, muscle, frame);
  return fs::exists(path) ? read_polylines(path, 1) : Polylines{};
}

TriangleMesh placed_surface(const RecordedRun& run, const std::string& name, int frame) {
  TriangleMesh surface = recorded_surface(run, name, frame);
  surface.vertices.colwise() -= run.place;
  return surface;
}

Polylines placed_fibers(const RecordedRun& run, const std::string& muscle, int frame) {
  Polylines fibers = recorded_fibers(run, muscle, frame);
  fibers.points.colwise() -= run.place;
  return fibers;
}

Points recorded_tissue(const RecordedRun& run, const std::string& muscle) {
  return read_vtp_vectors(frame_file(run.folder, muscle, 0), tissue_name);
}

RigidTransform rigid_motion(const Points& rest, const Points& now) {
  RigidTransform motion;
  motion.matrix() = Eigen::umeyama(rest, now, false);
  return motion;
}

int main_coordinate(const RecordedRun& run) {
  int found = -1;
  Real largest = -1;
  for (Index i = 0; i < run.coordinate_values.cols(); ++i) {
    const Real span = run.coordinate_values.col(i).maxCoeff() - run.coordinate_values.col(i).minCoeff();
    if (span > largest) largest = span, found = i;
  }
  return found;
}

int nearest_pose(const RecordedRun& run, int frame, const RecordedRun& other) {
  int best = 0;
  Real least = std::numeric_limits<Real>::infinity();
  for (int candidate = 0; candidate < other.frame_count; ++candidate) {
    Real distance = 1e-3 * std::abs(Real(candidate) / other.frame_count - Real(frame) / run.frame_count);
    for (std::size_t i = 0; i < run.coordinates.size(); ++i) {
      const auto same = std::find(other.coordinates.begin(), other.coordinates.end(), run.coordinates[i]);
      if (same == other.coordinates.end()) continue;
      distance += std::abs(other.coordinate_values(candidate, static_cast<Index>(same - other.coordinates.begin())) -
                           run.coordinate_values(frame, static_cast<Index>(i)));
    }
    if (distance < least) least = distance, best = candidate;
  }
  return best;
}

std::vector<int> spread_frames(int count, int most) {
  const int step = std::max(1, (count - 1 + most - 2) / (most - 1));
  std::vector<int> frames;
  for (int frame = 0; frame < count - 1; frame += step) frames.push_back(frame);
  frames.push_back(count - 1);
  return frames;
}

CoordinateLabel coordinate_label(const std::string& column) {
  if (column.ends_with("_deg")) return {column.substr(0, column.size() - 4), "°"};
  if (column.ends_with("_mm")) return {column.substr(0, column.size() - 3), " mm"};
  return {column, ""};
}

}  // namespace gracilis
