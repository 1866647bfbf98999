#include <gracilis/io/run/run_folder.hpp>

#include <gracilis/anatomy/activation/tendon.hpp>
#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/mesh/mesh_reader_vtp.hpp>
#include <gracilis/io/mesh/mesh_writer.hpp>
#include <gracilis/io/mesh/polyline_file.hpp>
#include <gracilis/io/mesh/vtp_pieces.hpp>
#include <gracilis/io/run/compact_frames.hpp>
#include <gracilis/io/run/measures_table.hpp>
#include <gracilis/io/run/output_hashes.hpp>
#include <gracilis/io/run/run_manifest.hpp>
#include <gracilis/io/scene/scene_template.hpp>
#include <gracilis/io/tables/action_tables.hpp>
#include <gracilis/io/tables/fiber_table.hpp>
#include <gracilis/io/tables/force_table.hpp>
#include <gracilis/io/value_reader.hpp>
#include <gracilis/methods/registry.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <functional>
#include <optional>

namespace gracilis {

namespace fs = std::filesystem;

static constexpr const char* velocity_name = "velocity";

static std::vector<std::string> surface_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const Muscle& muscle : scene.muscles) names.push_back(muscle.name);
  for (const Bone& bone : scene.bones) names.push_back(bone.name);
  return names;
}

Frame read_frame(const fs::path& folder, const Scene& scene, int number, const Pose& pose) {
  Frame frame;
  frame.number = number;
  frame.pose = pose;
  const RunLayout layout = layout_of(folder);
  std::optional<VtpFile> file;  // of a compact run all muscles are in one
  for (const Muscle& muscle : scene.muscles) {
    const fs::path path = file_of_surface(folder, layout, muscle.name, number);
    const bool own_file = layout == RunLayout::surfaces;
    if (own_file || !file) file.emplace(path);
    const TriangleMesh mesh = own_file ? triangulated(file->read(), 1, path) : read_vtp_piece(*file, muscle.name);
    if (mesh.vertex_count() != muscle.surface.vertex_count()) {
      throw InputError({path.string(), "",
                        fmt::format("has {} vertices, but {} has {}", mesh.vertex_count(), muscle.name,
                                    muscle.surface.vertex_count()),
                        "resume with the scene that the run was started with"});
    }
    const Points velocities = file->vectors(velocity_name, piece_of_muscle(layout, muscle.name));
    require_finite(mesh.vertices, path, "a vertex");
    require_finite(velocities, path, "a velocity");
    if (velocities.cols() > 0 && velocities.cols() != mesh.vertices.cols())
      throw InputError({path.string(), "", "does not have one velocity per vertex", "replace the run with --force"});
    frame.muscles.push_back({mesh.vertices, velocities});
  }
  return frame;
}

/// What a run resumes with in dynamic mode, and ParaView's glyphs show.
static std::vector<VertexArray> velocity_array(const MuscleShape& shape) {
  if (shape.velocities.cols() == 0) return {};
  return {{velocity_name, shape.velocities.reshaped(), 3}};
}

/// 1 or 0 where the vertex is of an origin, 1 or 0 where of an insertion, and how much of a belly it is, 0 to 1.
static VertexArray tissue_array(const Muscle& muscle, Real tendon_length) {
  Points tissue = Points::Zero(3, muscle.surface.vertex_count());
  for (const Attachment& attachment : muscle.attachments)
    for (const Index v : attachment.vertices) tissue(attachment.end == AttachmentEnd::origin ? 0 : 1, v) = 1;
  const std::vector<Real> belly = belly_shares(muscle, tendon_length);
  for (std::size_t v = 0; v < belly.size(); ++v) tissue(2, static_cast<Index>(v)) = belly[v];
  return {tissue_name, tissue.reshaped(), 3};
}

/// Of a run's folder `run`, which is named where the folder cannot be made.
static void create_run_folder(const fs::path& folder, const fs::path& run) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder))
    throw InputError({run.string(), "", "cannot be created: " + error.message(), "choose another folder with --out"});
}

/// What a run leaves behind in one of its folders from frame `first` on, and nothing else.
static std::vector<fs::path> frames_from(const fs::path& folder, int first) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() != ".vtp") continue;
    const std::string digits = stem.substr(stem.rfind('_') + 1);  // of names without, all of it
    const bool is_number = digits.size() >= 4 && digits.find_first_not_of("0123456789") == std::string::npos;
    Index number = 0;
    // A number beyond all indices is behind every frame.
    if (is_number && (!parse_index(digits, number) || number >= first)) files.push_back(entry.path());
  }
  return files;
}

/// Throws ConfigurationError where files lie in the folder that a run would remove or write anew. A run that was killed
/// has left run.pvd before any of them.
static void require_no_files_of_others(const fs::path& folder, const Scene& scene) {
  std::vector<fs::path> files;
  for (const char* name : {"measures.csv", "paraview.py", "preview.png", output_hashes_name})
    files.push_back(folder / name);
  for (const std::string& name : table_names(scene)) files.push_back(folder / name);
  for (const Bone& bone : scene.bones) files.push_back(bone_file(folder, bone.name));
  std::erase_if(files, [](const fs::path& file) { return !fs::exists(fs::symlink_status(file)); });
  for (const char* part : {"frames", "shapes", "fibers"})
    for (fs::path& file : frames_from(folder / part, 0)) files.push_back(std::move(file));
  if (files.empty()) return;
  throw ConfigurationError({std::min_element(files.begin(), files.end())->string(), "",
                            "is not of a run, and this run would replace it",
                            "--out names another folder, --force replaces it"});
}

RunFolder::RunFolder(fs::path folder, const Scene& scene, const std::vector<Pose>& poses, ExistingRun existing,
                     RunLayout layout)
    : folder_(std::move(folder)),
      layout_(existing == ExistingRun::resume ? layout_of(folder_, layout) : layout),
      scene_(scene),
      poses_(poses),
      opened_(std::chrono::steady_clock::now()) {
  create_run_folder(folder_, folder_);
  lock_.emplace(folder_);
  const bool has_run = fs::exists(folder_ / "run.json") || fs::exists(folder_ / "run.pvd");
  if (has_run && existing == ExistingRun::refuse) {
    throw ConfigurationError({folder_.string(), "", "holds a run already",
                              "--resume goes on with it, --force replaces it, --out names another folder"});
  }
  if (!has_run && existing != ExistingRun::replace) require_no_files_of_others(folder_, scene);
  create_run_folder(folder_ / (layout_ == RunLayout::compact ? "shapes" : "frames"), folder_);
  for (const char* part : {"", "frames", "shapes", "bones", "fibers", "plots"})
    remove_left_temporaries(folder_ / part, LeftBy::any_machine);
  if (existing == ExistingRun::resume) {
    require_same_columns(folder_ / "measures.csv", measures_header(scene));
    frame_count_ = std::min(count_frames(folder_, scene), static_cast<int>(poses.size()));
    require_same_poses(folder_ / "measures.csv", scene, poses, frame_count_);
    // The capture pose is the same by any settings.
    if (frame_count_ > 1 && is_there(folder_ / "run.json")) require_same_settings(folder_, settings_text(scene));
    const auto recorded = [&](int number) {
      return read_frame(folder_, scene, number, poses[static_cast<std::size_t>(number)]);
    };
    const bool is_complete = frame_count_ == static_cast<int>(poses.size());
    const int dropped = frame_count_ == 0 || is_complete ? 0 : (frame_count_ - 1) % resume_period(scene);
    if (dropped > 0) recorded(frame_count_ - 1);  // throws where this is another scene's run
    frame_count_ -= dropped;
    if (frame_count_ >= 2) {
      resume_point_ = ResumePoint{recorded(frame_count_ - 2), recorded(frame_count_ - 1)};
    } else {
      frame_count_ = 0;
    }
  }
  fs::remove(folder_ / output_hashes_name);
  remove_frames();
  truncate_measures(folder_ / "measures.csv", frame_count_);
  truncate_tables(static_cast<int>(poses_.size()));
  if (frame_count_ == 0) {
    fs::remove(folder_ / "measures.csv");
    for (const std::string& name : table_names(scene_)) fs::remove(folder_ / name);
  }
  write_index();
}

/// What comes after the frames that stay, and all of a run of the other layout.
void RunFolder::remove_frames() const {
  for (const char* part : {"frames", "shapes", "fibers"})
    for (const fs::path& file : frames_from(folder_ / part, frame_count_)) fs::remove(file);
  std::error_code ignored;  // what else lies in it keeps a folder
  fs::remove(folder_ / (layout_ == RunLayout::compact ? "frames" : "shapes"), ignored);
  if (layout_ == RunLayout::compact) return;
  fs::remove(folder_ / "paraview.py");
  for (const Bone& bone : scene_.bones) fs::remove(bone_file(folder_, bone.name), ignored);
  fs::remove(folder_ / "bones", ignored);
}

RunFolder::~RunFolder() {
  try {
    finish();
  } catch (const std::exception&) {
    // A destructor must not throw; whoever wants to know calls finish().
  }
}

/// Surfaces come last: a frame whose surfaces are all there is whole, however a run was ended.
void RunFolder::write_frame(const FrameRecord& record) {
  if (layout_ == RunLayout::compact && record.frame.number == 0) write_compact_bones(folder_, scene_);
  write_fibers(record);
  const int rows = static_cast<int>(poses_.size());
  if (const std::optional<RunTable> table = force_table(scene_, record, rows))
    append_measures(folder_ / table->name, table->head, table->row);
  append_measures(folder_ / "measures.csv", measures_header(scene_), measures_rows(scene_, record));
  layout_ == RunLayout::compact ? write_compact(record) : write_surfaces(record);
  frame_count_ = record.frame.number + 1;
  if (std::chrono::steady_clock::now() - indexed_ > std::chrono::seconds(1)) write_index();
}

std::string correction_name(const std::string& kind) {
  std::string name = "moved_by_" + kind + "_m";
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

std::vector<VertexArray> RunFolder::arrays_of(std::size_t muscle, const FrameRecord& record) const {
  const Frame& frame = record.frame;
  const MuscleShape& shape = frame.muscles[muscle];
  std::vector<VertexArray> arrays = velocity_array(shape);
  if (shape.fiber_stresses.size() > 0) arrays.push_back({fiber_stress_name, shape.fiber_stresses});
  if (frame.number == 0)
    arrays.push_back(tissue_array(scene_.muscles[muscle], tendon_length_of(scene_, scene_.muscles[muscle])));
  if (!record.corrections.empty())
    for (const auto& [kind, moved] : record.corrections[muscle])
      arrays.push_back({correction_name(kind), moved.reshaped(), 3});
  return arrays;
}

/// One file has the same arrays for all: what a muscle lacks are zeros, which nobody asks for.
static void make_alike(std::vector<std::vector<VertexArray>>& arrays, const Frame& frame) {
  const auto of_name = [](std::vector<VertexArray>& of, const std::string& name) {
    return std::find_if(of.begin(), of.end(), [&](const VertexArray& array) { return array.name == name; });
  };
  std::vector<VertexArray> kinds;
  for (std::vector<VertexArray>& each : arrays)
    for (const VertexArray& array : each)
      if (of_name(kinds, array.name) == kinds.end()) kinds.push_back({array.name, {}, array.components});
  for (std::size_t m = 0; m < arrays.size(); ++m) {
    std::vector<VertexArray> all = kinds;
    for (VertexArray& array : all) {
      const auto own = of_name(arrays[m], array.name);
      if (own != arrays[m].end())
        array = std::move(*own);
      else
        array.values = Eigen::VectorXd::Zero(array.components * frame.muscles[m].points.cols());
    }
    arrays[m] = std::move(all);
  }
}

void RunFolder::write_compact(const FrameRecord& record) const {
  const Frame& frame = record.frame;
  std::vector<std::vector<VertexArray>> arrays(scene_.muscles.size());
  parallel_for_each(arrays.size(), [&](std::size_t m) { arrays[m] = arrays_of(m, record); });
  make_alike(arrays, frame);
  write_compact_shapes(folder_, scene_, frame, arrays);
}

void RunFolder::write_surfaces(const FrameRecord& record) const {
  const Frame& frame = record.frame;
  const auto muscle_count = static_cast<Index>(scene_.muscles.size());
  const auto bone_count = static_cast<Index>(scene_.bones.size());
  parallel_for(muscle_count + bone_count, 1, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      if (i < muscle_count) {
        const Muscle& muscle = scene_.muscles[static_cast<std::size_t>(i)];
        const MuscleShape& shape = frame.muscles[static_cast<std::size_t>(i)];
        write_surface(frame_file(folder_, muscle.name, frame.number), shape.points, muscle.surface.faces,
                      arrays_of(static_cast<std::size_t>(i), record));
      } else {
        const Bone& bone = scene_.bones[static_cast<std::size_t>(i - muscle_count)];
        const RigidTransform& motion = frame.pose.bodies[static_cast<std::size_t>(bone.body)];
        // Frame 0 is the input itself; arithmetic with the identity could turn a -0 into a 0.
        write_surface(frame_file(folder_, bone.name, frame.number),
                      frame.number == 0 ? bone.surface.vertices : Points(motion * bone.surface.vertices),
                      bone.surface.faces);
      }
    }
  });
}

void RunFolder::write_fibers(const FrameRecord& record) {
  const auto muscles = static_cast<Index>(record.fibers.size());
  if (std::all_of(record.fibers.begin(), record.fibers.end(), [](const auto& m) { return m.lengths.empty(); })) return;
  fs::create_directories(folder_ / "fibers");
  if (layout_ == RunLayout::compact) write_compact_fibers(folder_, scene_, record);
  parallel_for(layout_ == RunLayout::compact ? 0 : muscles, 1, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const MuscleFibers& fibers = record.fibers[static_cast<std::size_t>(i)];
      if (fibers.lengths.empty()) continue;
      write_polylines(fiber_file(folder_, scene_.muscles[static_cast<std::size_t>(i)].name, record.frame.number),
                      fibers.lines, {{"length_m", fibers.lengths}});
    }
  });
  for (const RunTable& table : action_tables(scene_, record, static_cast<int>(poses_.size())))
    append_measures(folder_ / table.name, table.head, table.row);
  append_measures(folder_ / "fiber_lengths.sto",
                  fiber_lengths_head(scene_, record.fibers, static_cast<int>(poses_.size())),
                  fiber_lengths_row(scene_, record.frame.pose, record.fibers));
}

void RunFolder::truncate_tables(int announced) const {
  for (const std::string& name : table_names(scene_)) truncate_fiber_lengths(folder_ / name, frame_count_, announced);
}

void RunFolder::write_manifest(RunManifest manifest) const {
  manifest.frames = frame_count_;
  const bool goes_on = manifest.status == "running" || manifest.status == "interrupted";
  if (!goes_on) manifest.outputs_sha256 = write_output_hashes(folder_);
  manifest.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - opened_).count();
  gracilis::write_manifest(folder_ / "run.json", manifest);
}

void RunFolder::finish() {
  if (indexed_frames_ != frame_count_) write_index();
  // Until now the head announced all rows to come.
  if (frame_count_ < static_cast<int>(poses_.size())) {
    truncate_tables(frame_count_);
  }
}

void RunFolder::write_index() {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  const bool compact = layout_ == RunLayout::compact;
  const std::vector<std::string> names = compact ? std::vector<std::string>{"muscles"} : surface_names(scene_);
  for (int number = 0; number < frame_count_; ++number) {
    for (std::size_t part = 0; part < names.size(); ++part) {
      text += fmt::format("    <DataSet timestep=\"{:.9g}\" group=\"\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n",
                          poses_[static_cast<std::size_t>(number)].time, part, names[part],
                          file_of_surface("", layout_, names[part], number).generic_string());
    }
  }
  write_text_atomically(folder_ / "run.pvd", text + "  </Collection>\n</VTKFile>\n");
  indexed_frames_ = frame_count_;
  indexed_ = std::chrono::steady_clock::now();
}

}  // namespace gracilis
