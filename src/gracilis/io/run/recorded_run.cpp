#include <gracilis/io/run/recorded_run.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/io/mesh/mesh_reader_vtp.hpp>
#include <gracilis/io/mesh/polyline_file.hpp>
#include <gracilis/io/run/run_folder.hpp>
#include <gracilis/io/run/run_manifest.hpp>
#include <gracilis/io/tables/fiber_table.hpp>
#include <gracilis/io/tables/force_table.hpp>
#include <gracilis/io/tables/table.hpp>
#include <gracilis/io/text_cells.hpp>
#include <gracilis/io/value_reader.hpp>
#include <gracilis/scene/names.hpp>
#include <gracilis/scene/scene_place.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace gracilis {

namespace fs = std::filesystem;

static Vec3 vector_of(const nlohmann::ordered_json& manifest, const char* group, const char* key,
                      const Vec3& otherwise) {
  const auto found = manifest.find(group);
  if (found == manifest.end() || !found->is_object() || !found->contains(key)) return otherwise;
  const nlohmann::ordered_json& json = (*found)[key];
  if (!json.is_array() || json.size() != 3) return otherwise;
  for (const auto& number : json)
    if (!number.is_number()) return otherwise;
  return {json[0].get<Real>(), json[1].get<Real>(), json[2].get<Real>()};
}

static AnatomicalAxes axes_of(const nlohmann::ordered_json& manifest) {
  AnatomicalAxes axes;
  axes.anterior = vector_of(manifest, "axes", "anterior", axes.anterior);
  axes.superior = vector_of(manifest, "axes", "superior", axes.superior);
  return axes;
}

namespace {

/// One row of measures.csv.
struct Row {
  Index frame = 0;
  std::size_t muscle = 0;
  std::vector<Real> before, after;  ///< the muscle's column: time and coordinates; measures
};

}  // namespace

static Real number_in(const ValueReader& reader, std::string_view cell, std::string_view column) {
  double value = 0;
  if (!parse_number(cell, value) || !std::isfinite(value))
    reader.fail(fmt::format("'{}' in column '{}' is not a finite number", cell.substr(0, 40), column.substr(0, 40)),
                "run the scene again");
  return value;
}

/// nan where it was not measured: the cell is empty, or, in columns of fibers, nan as earlier versions wrote it.
static Real measure_in(const ValueReader& reader, std::string_view cell, std::string_view column) {
  const bool of_fibers = column == "fiber_strain_mean" || column.ends_with("cross_section_cm2");
  if (cell.empty() || (of_fibers && cell == "nan")) return std::numeric_limits<Real>::quiet_NaN();
  return number_in(reader, cell, column);
}

/// The rows of measures.csv.
static std::vector<Row> read_rows(ValueReader& reader, const std::vector<std::string_view>& columns,
                                  std::size_t muscle_at, RecordedRun& run) {
  std::vector<Row> rows;
  std::map<std::string, std::size_t, std::less<>> numbers;
  while (!reader.at_end()) {
    const std::vector<std::string_view> cells = cells_of(reader.line());
    Row row;
    if (cells.size() != columns.size())
      reader.fail(fmt::format("has {} cells where there are {} columns", cells.size(), columns.size()),
                  "run the scene again");
    if (!parse_index(cells[0], row.frame))
      reader.fail(fmt::format("'{}' is not the number of a frame", cells[0].substr(0, 40)), "run the scene again");
    const auto [name, is_new] = numbers.emplace(cells[muscle_at], numbers.size());
    row.muscle = name->second;
    if (is_new) {
      if (!fits_file_name(cells[muscle_at]))
        reader.fail(fmt::format("'{}' is not the name of a muscle", cells[muscle_at].substr(0, 40)),
                    "run the scene again");
      run.muscles.emplace_back(cells[muscle_at]);
    }
    for (std::size_t i = 1; i < muscle_at; ++i) row.before.push_back(number_in(reader, cells[i], columns[i]));
    for (std::size_t i = muscle_at + 1; i < cells.size(); ++i)
      row.after.push_back(measure_in(reader, cells[i], columns[i]));
    rows.push_back(std::move(row));
  }
  return rows;
}

/// How many frames, counted from 0, have exactly one row for each muscle. An interruption may leave the last one with
/// fewer; everything else is an error. Frames are counted against rows first, so that no cell can ask for memory.
static Index count_measured(const ValueReader& reader, const std::vector<Row>& rows, std::size_t muscles) {
  const auto fail = [&](const std::string& what) {
    reader.fail("does not have one row per frame and muscle: " + what, "run the scene again");
  };
  std::vector<std::size_t> counts(rows.size(), 0);
  for (const Row& row : rows) {
    if (static_cast<std::size_t>(row.frame) >= rows.size())
      fail(fmt::format("frame {} among {} rows", row.frame, rows.size()));
    ++counts[static_cast<std::size_t>(row.frame)];
  }
  while (!counts.empty() && counts.back() == 0) counts.pop_back();
  if (!counts.empty() && counts.back() < muscles) counts.pop_back();
  if (counts.empty()) reader.fail("holds no whole frame", "run the scene again");
  for (std::size_t frame = 0; frame < counts.size(); ++frame)
    if (counts[frame] != muscles) fail(fmt::format("frame {} has {} for {} muscles", frame, counts[frame], muscles));
  std::vector<bool> seen(counts.size() * muscles, false);
  for (const Row& row : rows) {
    const std::size_t cell = static_cast<std::size_t>(row.frame) * muscles + row.muscle;
    if (cell >= seen.size()) continue;
    if (seen[cell]) fail(fmt::format("frame {} has two of a muscle", row.frame));
    seen[cell] = true;
  }
  return static_cast<Index>(counts.size());
}

/// Fills everything that stands in measures.csv.
static void read_measures(const fs::path& path, RecordedRun& run) {
  std::string text = read_text(path);
  text.resize(text.rfind('\n') + 1);  // what stands behind was cut off by an interruption
  ValueReader reader(path, text);
  const std::string head(reader.line());
  const std::vector<std::string_view> columns = cells_of(head);
  const auto muscle_at =
      static_cast<std::size_t>(std::find(columns.begin(), columns.end(), "muscle") - columns.begin());
  if (muscle_at < 2 || muscle_at + 1 >= columns.size() || columns[0] != "frame")
    reader.fail("does not begin with frame, time, coordinates and muscle", "run the scene again");
  run.coordinates.assign(columns.begin() + 2, columns.begin() + static_cast<std::ptrdiff_t>(muscle_at));
  run.measures.assign(columns.begin() + static_cast<std::ptrdiff_t>(muscle_at) + 1, columns.end());

  const std::vector<Row> rows = read_rows(reader, columns, muscle_at, run);
  run.frame_count = count_measured(reader, rows, run.muscles.size());
  const auto frames = static_cast<std::size_t>(run.frame_count);
  run.times.resize(frames);
  run.coordinate_values.resize(run.frame_count, static_cast<Index>(run.coordinates.size()));
  run.values.assign(run.measures.size(), Eigen::MatrixXd(run.frame_count, static_cast<Index>(run.muscles.size())));
  for (const Row& row : rows) {
    if (row.frame >= run.frame_count) continue;
    run.times[static_cast<std::size_t>(row.frame)] = row.before[0];
    for (std::size_t i = 1; i < row.before.size(); ++i)
      run.coordinate_values(row.frame, static_cast<Index>(i) - 1) = row.before[i];
    for (std::size_t i = 0; i < row.after.size(); ++i)
      run.values[i](row.frame, static_cast<Index>(row.muscle)) = row.after[i];
  }
}

/// Whatever of frame 0 is no muscle.
static std::vector<std::string> find_bones(const RecordedRun& run) {
  const bool compact = run.layout == RunLayout::compact;
  const std::string end = compact ? ".vtp" : "_0000.vtp", part = compact ? "bones" : "frames";
  if (!fs::is_directory(run.folder / part))
    throw InputError({run.folder.string(), "", "has no folder '" + part + "'", "run the scene again"});
  std::vector<std::string> bones;
  for (const fs::directory_entry& entry : fs::directory_iterator(run.folder / part)) {
    const std::string file = entry.path().filename().string();
    if (file.front() == '.' || !file.ends_with(end)) continue;
    const std::string name = file.substr(0, file.size() - end.size());
    if (std::find(run.muscles.begin(), run.muscles.end(), name) == run.muscles.end()) bones.push_back(name);
  }
  std::sort(bones.begin(), bones.end());
  return bones;
}

static void find_surfaces(RecordedRun& run) {
  run.bones = find_bones(run);
  std::vector<std::string> names = run.muscles;
  names.insert(names.end(), run.bones.begin(), run.bones.end());
  if (run.layout == RunLayout::compact) names = {""};  // a file has all
  int complete = 0;
  const auto is_there = [&](const std::string& name) {
    return fs::exists(file_of_surface(run.folder, run.layout, name, complete));
  };
  while (complete < run.frame_count && std::all_of(names.begin(), names.end(), is_there)) ++complete;
  if (complete == 0) throw InputError({run.folder.string(), "", "holds no complete frame", "run the scene again"});
  run.frame_count = complete;
  run.times.resize(static_cast<std::size_t>(complete));
  run.coordinate_values.conservativeResize(complete, Eigen::NoChange);
  for (Eigen::MatrixXd& values : run.values) values.conservativeResize(complete, Eigen::NoChange);
}

Eigen::MatrixXd measure_of(const RecordedRun& run, const std::string& measure) {
  const auto found = std::find(run.measures.begin(), run.measures.end(), measure);
  if (found == run.measures.end()) return {};
  return run.values[static_cast<std::size_t>(found - run.measures.begin())];
}

/// Throws InputError unless there are as many of a surface's vertices as in frame 0.
void require_count(const RecordedRun& run, const std::string& name, int frame, Eigen::Index count) {
  if (const auto found = run.vertex_counts.find(name); found != run.vertex_counts.end())
    require_vertices(file_of_surface(run.folder, run.layout, name, frame), static_cast<Index>(count), found->second);
}

static TriangleMesh read_surface(const RecordedRun& run, const std::string& name, int frame) {
  if (!run.compact_shapes) {
    TriangleMesh surface = read_mesh(frame_file(run.folder, name, frame), 1);
    require_finite(surface.vertices, frame_file(run.folder, name, frame), "a vertex");
    return surface;
  }
  const bool is_bone = std::find(run.bones.begin(), run.bones.end(), name) != run.bones.end();
  return is_bone ? run.compact_shapes->bone(name, frame) : run.compact_shapes->muscle(name, frame);
}

TriangleMesh recorded_surface(const RecordedRun& run, const std::string& name, int frame) {
  TriangleMesh surface = read_surface(run, name, frame);
  require_count(run, name, frame, surface.vertex_count());
  return surface;
}

/// All surfaces of a run keep their vertices, and so do all that draw or measure them.
static void count_vertices(RecordedRun& run) {
  std::vector<std::string> names = run.muscles;
  names.insert(names.end(), run.bones.begin(), run.bones.end());
  std::vector<Index> counts(names.size());
  parallel_for_each(names.size(), [&](std::size_t i) { counts[i] = read_surface(run, names[i], 0).vertex_count(); });
  for (std::size_t i = 0; i < names.size(); ++i) run.vertex_counts[names[i]] = counts[i];
}

RecordedRun open_recorded_run(const fs::path& folder) {
  RecordedRun run;
  run.folder = folder;
  run.manifest = read_manifest(folder);
  run.layout = layout_of(folder);
  if (run.layout == RunLayout::compact) {
    run.compact_shapes = std::make_shared<CompactShapes>(folder);
    run.compact_fibers = std::make_shared<CompactFibers>(run.compact_shapes);
  }
  run.axes = axes_of(run.manifest);
  run.preview_looking = vector_of(run.manifest, "preview", "looking", Vec3::Zero());
  run.preview_up = vector_of(run.manifest, "preview", "up", Vec3::Zero());
  read_measures(folder / "measures.csv", run);
  find_surfaces(run);
  run.first_motion_frame = std::clamp(static_cast<int>(run.manifest.value("first_motion_frame", Real(0))), 0,
                                      run.frame_count);  // an interrupted run may not have come there
  count_vertices(run);
  run.place = place_of(bounding_box(recorded_surface(run, run.muscles.front(), 0).vertices));
  return run;
}

Polylines recorded_fibers(const RecordedRun& run, const std::string& muscle, int frame) {
  if (run.compact_fibers) return run.compact_fibers->read(muscle, frame);
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

std::shared_ptr<const VtpFile> file_of_muscle(const RecordedRun& run, const std::string& muscle, int frame) {
  if (run.compact_shapes) return run.compact_shapes->file(frame);
  return std::make_shared<const VtpFile>(frame_file(run.folder, muscle, frame));
}

Points recorded_tissue(const RecordedRun& run, const std::string& muscle) {
  Points tissue = file_of_muscle(run, muscle, 0)->vectors(tissue_name, piece_of_muscle(run.layout, muscle));
  if (tissue.cols() > 0) require_count(run, muscle, 0, tissue.cols());
  require_finite(tissue, file_of_surface(run.folder, run.layout, muscle, 0), "a share of tissue");
  return tissue;
}

Eigen::VectorXd recorded_fiber_stresses(const RecordedRun& run, const std::string& muscle, int frame) {
  if (!fs::exists(run.folder / force_file)) return {};  // the method knows none: no need to read every frame for that
  Eigen::VectorXd stresses =
      file_of_muscle(run, muscle, frame)->scalars(fiber_stress_name, piece_of_muscle(run.layout, muscle));
  if (stresses.size() > 0) require_count(run, muscle, frame, stresses.size());
  require_finite(stresses, file_of_surface(run.folder, run.layout, muscle, frame), "a stress");
  return stresses;
}

std::vector<Eigen::MatrixXd> recorded_tensions(const RecordedRun& run) {
  std::vector<Eigen::MatrixXd> tensions(run.muscles.size());
  if (!fs::exists(run.folder / force_file)) return tensions;
  const Table table = read_table(run.folder / force_file);
  const Eigen::Index rows = std::min<Eigen::Index>(table.values.rows(), run.frame_count);
  for (std::size_t m = 0; m < tensions.size(); ++m) {
    std::vector<Eigen::Index> columns;
    while (const auto found =
               column_of(table, fiber_name(run.muscles[m], static_cast<Index>(columns.size())) + "_tension"))
      columns.push_back(*found);
    if (!columns.empty()) tensions[m] = table.values.topRows(rows)(Eigen::all, columns);
  }
  return tensions;
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
