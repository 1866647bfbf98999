#include <gracilis/study/trajectories.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/hdf5_writer.hpp>
#include <gracilis/io/run/recorded_run.hpp>

namespace gracilis {

namespace {

/// Thrown for a run of which not all can be read.
struct Unreadable {
  std::string reason;
};

template <class Read>
auto read(const Read& from_run) {
  try {
    return from_run();
  } catch (const InputError& error) {
    throw Unreadable{error.what()};
  }
}

std::uint64_t size(Index count) { return static_cast<std::uint64_t>(count); }

/// With the row in front, as the file has it.
void write_table(Hdf5Writer& file, const std::string& name, const Eigen::MatrixXd& table,
                 const std::vector<std::string>& columns) {
  if (table.size() == 0) return;
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = table;
  file.write(name, {size(rows.rows()), size(rows.cols())},
             std::span<const double>(rows.data(), static_cast<std::size_t>(rows.size())));
  file.describe(name, "columns", columns);
}

/// Points of all frames, one after the other.
class PointTrack {
 public:
  void add(const Points& points) {
    if (frames_ == 0) count_ = points.cols();
    is_even_ &= points.cols() == count_;
    const Eigen::Matrix3Xf single = points.cast<float>();
    values_.insert(values_.end(), single.data(), single.data() + single.size());
    ++frames_;
  }
  /// Nothing where there are no points, or not as many in every frame.
  void write(Hdf5Writer& file, const std::string& name) const {
    if (is_even_ && count_ > 0) file.write(name, {frames_, size(count_), 3}, std::span<const float>(values_));
  }

 private:
  std::vector<float> values_;
  Index count_ = 0;
  std::uint64_t frames_ = 0;
  bool is_even_ = true;
};

void write_surface(Hdf5Writer& file, const RecordedRun& run, const std::string& surface, const std::string& group) {
  PointTrack vertices;
  Eigen::Matrix3Xi faces;
  for (int frame = 0; frame < run.frame_count; ++frame) {
    TriangleMesh mesh = read([&] { return recorded_surface(run, surface, frame); });
    vertices.add(mesh.vertices);
    if (frame == 0) faces = std::move(mesh.faces);
  }
  file.write(group + "/faces", {size(faces.cols()), 3},
             std::span<const std::int32_t>(faces.data(), static_cast<std::size_t>(faces.size())));
  vertices.write(file, group + "/vertices");
}

void write_fibers(Hdf5Writer& file, const RecordedRun& run, const std::string& muscle, const std::string& group) {
  PointTrack points;
  std::vector<Index> offsets;
  for (int frame = 0; frame < run.frame_count; ++frame) {
    const Polylines fibers = read([&] { return recorded_fibers(run, muscle, frame); });
    if (frame == 0) offsets = fibers.offsets;
    if (fibers.count() == 0 || fibers.offsets != offsets) return;  // lines that change are left to the run's files
    points.add(fibers.points);
  }
  points.write(file, group + "/fiber_points");
  file.write(group + "/fiber_offsets", {offsets.size()}, std::span<const std::int32_t>(offsets));
}

void write_run(Hdf5Writer& file, const Study& study, const StudyRun& of_study, const std::string& group) {
  const RecordedRun run = read([&] { return open_recorded_run(complete_folder(study, of_study)); });
  file.make_group(group);
  file.describe(group, "scene", of_study.scene);
  file.describe(group, "parameters", study.parameters);
  file.describe(group, "values", of_study.values);
  file.write(group + "/time", {run.times.size()}, std::span<const double>(run.times));
  write_table(file, group + "/coordinates", run.coordinate_values, run.coordinates);
  for (std::size_t m = 0; m < run.measures.size(); ++m)
    write_table(file, group + "/measures/" + run.measures[m], run.values[m], run.muscles);
  for (const std::string& muscle : run.muscles) {
    write_surface(file, run, muscle, group + "/muscles/" + muscle);
    write_fibers(file, run, muscle, group + "/muscles/" + muscle);
  }
  for (const std::string& bone : run.bones) write_surface(file, run, bone, group + "/bones/" + bone);
}

}  // namespace

TrajectoryEnd write_trajectories(const Study& study, const std::string& version) {
  TrajectoryEnd end;
  InputHashes hashes;
  const std::filesystem::path out = study.folder / trajectory_file;
  write_file_atomically(out, [&](const std::filesystem::path& temporary) {
    Hdf5Writer file(temporary, out);
    file.describe("/", "study", study.file.filename().string());
    file.describe("/", "written_by", "Gracilis " + version);
    file.make_group("/runs");
    for (const StudyRun& run : study.runs) {
      const RunStanding standing = standing_of(study, run, version, hashes, AbsentInput::is_passed_over);
      if (standing.state != RunState::complete) continue;
      const std::string group = "/runs/" + run.name;
      try {
        write_run(file, study, run, group);
        ++end.runs;
      } catch (const Unreadable& error) {
        file.remove(group);
        end.skipped.push_back(run.name + ": " + error.reason);
      }
    }
    file.close();
  });
  return end;
}

}  // namespace gracilis
