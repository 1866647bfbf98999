#include <gracilis/io/run/compact_frames.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/surface_binding.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/io/mesh/vtp_pieces.hpp>
#include <gracilis/io/run/paraview_script.hpp>
#include <gracilis/io/run/run_layout.hpp>

#include <algorithm>
#include <list>
#include <map>
#include <mutex>
#include <utility>

namespace gracilis {

namespace fs = std::filesystem;

/// The field of a frame's file that holds a bone's motion since the capture pose: twelve numbers, column by column.
static std::string motion_name(const std::string& bone) { return "motion_of_" + bone; }

static Eigen::VectorXd motion_values(const RigidTransform& motion) {
  const Eigen::Matrix<Real, 3, 4> matrix = motion.matrix().topRows<3>();
  return Eigen::Map<const Eigen::VectorXd>(matrix.data(), 12);
}

void write_compact_bones(const fs::path& folder, const Scene& scene) {
  fs::create_directories(folder / "bones");
  parallel_for_each(scene.bones.size(), [&](std::size_t b) {
    const Bone& bone = scene.bones[b];
    write_surface(bone_file(folder, bone.name), bone.surface.vertices, bone.surface.faces);
  });
  write_text_atomically(folder / "paraview.py", paraview_script(scene));
}

void write_compact_shapes(const fs::path& folder, const Scene& scene, const Frame& frame,
                          const std::vector<std::vector<VertexArray>>& arrays) {
  std::vector<VtpPiece> pieces;
  for (std::size_t m = 0; m < scene.muscles.size(); ++m) {
    VtpPiece piece{scene.muscles[m].name, frame.muscles[m].points, scene.muscles[m].surface.faces};
    piece.arrays = arrays[m];
    pieces.push_back(std::move(piece));
  }
  std::vector<VtpField> motions;
  for (const Bone& bone : scene.bones)
    motions.emplace_back(motion_name(bone.name), motion_values(frame.pose.bodies[static_cast<std::size_t>(bone.body)]));
  fs::create_directories(folder / "shapes");
  write_vtp_pieces(shapes_file(folder, frame.number), pieces, motions);
}

void write_compact_fibers(const fs::path& folder, const Scene& scene, const FrameRecord& record) {
  std::vector<VtpPiece> pieces;
  for (std::size_t m = 0; m < record.fibers.size(); ++m) {
    const bool follows = record.frame.muscles[m].fibers.count() == 0;
    if (record.fibers[m].lines.count() == 0 || (follows && record.frame.number > 0)) continue;
    VtpPiece piece{scene.muscles[m].name, record.fibers[m].lines.points};
    piece.line_offsets = record.fibers[m].lines.offsets;
    pieces.push_back(std::move(piece));
  }
  if (pieces.empty()) return;
  fs::create_directories(folder / "fibers");
  write_vtp_pieces(fibers_file(folder, record.frame.number), pieces);
}

struct CompactShapes::Kept {
  struct Bone {
    std::once_flag once;
    TriangleMesh rest;
  };
  std::mutex mutex;
  std::size_t most_bytes = 0, bytes = 0;
  int files_read = 0;
  std::list<std::pair<int, std::shared_ptr<const VtpFile>>> frames;  ///< last asked for first
  std::map<std::string, Bone> bones;

  std::shared_ptr<const VtpFile> find(int frame) {
    const auto found =
        std::find_if(frames.begin(), frames.end(), [&](const auto& each) { return each.first == frame; });
    if (found == frames.end()) return nullptr;
    frames.splice(frames.begin(), frames, found);
    return frames.front().second;
  }
  void keep(int frame, const std::shared_ptr<const VtpFile>& file) {
    frames.emplace_front(frame, file);
    bytes += file->size();
    while (bytes > most_bytes && frames.size() > 1) {
      bytes -= frames.back().second->size();
      frames.pop_back();
    }
  }
};

CompactShapes::CompactShapes(fs::path folder, std::size_t most_bytes)
    : folder_(std::move(folder)), kept_(std::make_unique<Kept>()) {
  kept_->most_bytes = most_bytes;
}
CompactShapes::~CompactShapes() = default;

int CompactShapes::files_read() const {
  const std::lock_guard lock(kept_->mutex);
  return kept_->files_read;
}

std::shared_ptr<const VtpFile> CompactShapes::file(int frame) const {
  // Behind the lock: of several threads that ask for a frame the first one reads it.
  const std::lock_guard lock(kept_->mutex);
  if (std::shared_ptr<const VtpFile> known = kept_->find(frame)) return known;
  auto file = std::make_shared<const VtpFile>(shapes_file(folder_, frame));
  ++kept_->files_read;
  kept_->keep(frame, file);
  return file;
}

TriangleMesh CompactShapes::muscle(const std::string& name, int frame) const {
  TriangleMesh surface = read_vtp_piece(*file(frame), name);
  require_finite(surface.vertices, shapes_file(folder_, frame), "a vertex");
  return surface;
}

TriangleMesh CompactShapes::bone(const std::string& name, int frame) const {
  Kept::Bone* bone = nullptr;
  {
    const std::lock_guard lock(kept_->mutex);
    bone = &kept_->bones[name];
  }
  std::call_once(bone->once, [&] {
    bone->rest = read_mesh(bone_file(folder_, name), 1);
    require_finite(bone->rest.vertices, bone_file(folder_, name), "a vertex");
  });
  TriangleMesh surface = bone->rest;
  if (frame == 0) return surface;  // the input itself; arithmetic with the identity could turn a -0 into a 0
  const std::vector<double> values = file(frame)->field(motion_name(name));
  if (values.size() != 12)
    throw InputError({shapes_file(folder_, frame).string(), motion_name(name), "does not hold the bone's motion",
                      "run the scene again"});
  RigidTransform motion;
  motion.matrix().topRows<3>() = Eigen::Map<const Eigen::Matrix<Real, 3, 4>>(values.data());
  require_finite(motion.matrix(), shapes_file(folder_, frame), "a motion of " + name);
  surface.vertices = motion * surface.vertices;
  return surface;
}

/// What was bound, per muscle.
struct CompactFibers::Bindings {
  struct Bound {
    std::once_flag once;
    Polylines rest;
    Index vertices = 0;                       ///< of the surface
    std::unique_ptr<SurfaceBinding> binding;  ///< null: no fibers
  };
  std::mutex mutex;
  std::map<std::string, Bound> of_muscles;
};

CompactFibers::CompactFibers(std::shared_ptr<const CompactShapes> shapes)
    : shapes_(std::move(shapes)), bindings_(std::make_unique<Bindings>()) {}
CompactFibers::~CompactFibers() = default;

Polylines CompactFibers::read(const std::string& muscle, int frame) const {
  const fs::path& folder = shapes_->folder();
  const fs::path known = fibers_file(folder, frame);
  if (is_there(known))
    if (Polylines fibers = read_vtp_lines(known, muscle); fibers.count() > 0 || frame == 0) return fibers;
  if (frame == 0 || !is_there(fibers_file(folder, 0))) return {};
  Bindings::Bound* bound = nullptr;
  {
    const std::lock_guard lock(bindings_->mutex);
    bound = &bindings_->of_muscles[muscle];
  }
  std::call_once(bound->once, [&] {
    bound->rest = read_vtp_lines(fibers_file(folder, 0), muscle);
    if (bound->rest.count() == 0) return;
    const TriangleMesh surface = shapes_->muscle(muscle, 0);
    bound->vertices = surface.vertex_count();
    bound->binding = std::make_unique<SurfaceBinding>(surface, bound->rest.points);
  });
  Polylines fibers = bound->rest;
  if (!bound->binding) return fibers;
  const Points now = shapes_->muscle(muscle, frame).vertices;
  require_vertices(shapes_file(folder, frame), static_cast<Index>(now.cols()), bound->vertices);
  fibers.points = bound->binding->evaluate(now);
  return fibers;
}

}  // namespace gracilis
