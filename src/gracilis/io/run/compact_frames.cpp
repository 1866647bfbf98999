#include <gracilis/io/run/compact_frames.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/surface_binding.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/io/mesh/mesh_reader_vtp.hpp>
#include <gracilis/io/mesh/vtp_pieces.hpp>
#include <gracilis/io/run/paraview_script.hpp>
#include <gracilis/io/run/run_layout.hpp>

#include <map>
#include <mutex>

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

TriangleMesh read_compact_muscle(const fs::path& folder, const std::string& muscle, int frame) {
  return read_vtp_piece(shapes_file(folder, frame), muscle);
}

TriangleMesh read_compact_bone(const fs::path& folder, const std::string& bone, int frame) {
  TriangleMesh surface = read_mesh(bone_file(folder, bone), 1);
  if (frame == 0) return surface;  // the input itself; arithmetic with the identity could turn a -0 into a 0
  const fs::path path = shapes_file(folder, frame);
  const std::vector<double> values = read_vtp_field(path, motion_name(bone));
  if (values.size() != 12)
    throw InputError({path.string(), motion_name(bone), "does not hold the bone's motion", "run the scene again"});
  RigidTransform motion;
  motion.matrix().topRows<3>() = Eigen::Map<const Eigen::Matrix<Real, 3, 4>>(values.data());
  surface.vertices = motion * surface.vertices;
  return surface;
}

/// What was bound, per muscle.
struct CompactFibers::Bindings {
  struct Bound {
    std::once_flag once;
    Polylines rest;
    std::unique_ptr<SurfaceBinding> binding;  ///< null: no fibers
  };
  std::mutex mutex;
  std::map<std::string, Bound> of_muscles;
};

CompactFibers::CompactFibers(fs::path folder) : folder_(std::move(folder)), bindings_(std::make_unique<Bindings>()) {}
CompactFibers::~CompactFibers() = default;

Polylines CompactFibers::read(const std::string& muscle, int frame) const {
  const fs::path known = fibers_file(folder_, frame);
  if (is_there(known))
    if (Polylines fibers = read_vtp_lines(known, muscle); fibers.count() > 0 || frame == 0) return fibers;
  if (frame == 0 || !is_there(fibers_file(folder_, 0))) return {};
  Bindings::Bound* bound = nullptr;
  {
    const std::lock_guard lock(bindings_->mutex);
    bound = &bindings_->of_muscles[muscle];
  }
  std::call_once(bound->once, [&] {
    bound->rest = read_vtp_lines(fibers_file(folder_, 0), muscle);
    if (bound->rest.count() == 0) return;
    bound->binding = std::make_unique<SurfaceBinding>(read_compact_muscle(folder_, muscle, 0), bound->rest.points);
  });
  Polylines fibers = bound->rest;
  if (bound->binding) fibers.points = bound->binding->evaluate(read_compact_muscle(folder_, muscle, frame).vertices);
  return fibers;
}

}  // namespace gracilis
