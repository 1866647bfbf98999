#include <gracilis/io/run/run_size.hpp>

#include <gracilis/dynamics/solver/constraint_table.hpp>
#include <gracilis/methods/registry.hpp>

#include <fmt/format.h>

namespace gracilis {

namespace {

constexpr double header_bytes = 1200;    ///< of a file
constexpr double vertex_bytes = 24;      ///< three numbers in double precision
constexpr double triangle_bytes = 16;    ///< three corners and an end
constexpr double line_point_bytes = 28;  ///< and its place in a line
constexpr double length_bytes = 12;      ///< of a fiber in a table, as text
constexpr double fiber_bytes = 20 + length_bytes;
constexpr double piece_bytes = 500;          ///< what a compact file says of a muscle before its numbers
constexpr double packed_triangle_bytes = 4;  ///< of a compact file
constexpr double measures_bytes = 160;       ///< a row of measures.csv

double surface_bytes(const TriangleMesh& surface) {
  return header_bytes + vertex_bytes * surface.vertex_count() + triangle_bytes * surface.face_count();
}

/// What a method writes of a muscle's fibers.
struct WrittenFibers {
  double count = 0, points_of_each = 0;
  bool follow_surface = true;  ///< otherwise a compact run has them in every frame

  double bytes() const { return header_bytes + (line_point_bytes * points_of_each + fiber_bytes) * count; }
};

WrittenFibers written_fibers(const Scene& scene, const Muscle& muscle) {
  WrittenFibers fibers{static_cast<double>(muscle.fibers.count), muscle.fibers.segments + 1.0};
  if (const auto own_fibers = method_of(scene).own_fibers) {
    const OwnFibers own = own_fibers(scene, muscle);
    fibers = {static_cast<double>(own.count), static_cast<double>(own.points_of_each), false};
  }
  const bool given = muscle.given_fibers.count() > 0 && !muscle.given_are_superficial;
  if (given) fibers.count = static_cast<double>(muscle.given_fibers.count());
  return fibers;
}

}  // namespace

static RunSize compact_size(const Scene& scene, int frames, bool with_fibers) {
  double frame = header_bytes, once = 0;
  for (const Bone& bone : scene.bones) once += surface_bytes(bone.surface);
  for (const Muscle& muscle : scene.muscles) {
    const bool has_fibers = with_fibers && muscle.fibers.count > 0;
    frame += piece_bytes + vertex_bytes * muscle.surface.vertex_count() +
             packed_triangle_bytes * muscle.surface.face_count() + measures_bytes;
    if (!has_fibers) continue;
    const WrittenFibers fibers = written_fibers(scene, muscle);
    (fibers.follow_surface ? once : frame) += fibers.bytes();
    frame += length_bytes * fibers.count;
  }
  return {once + frame * frames, frames + static_cast<std::int64_t>(scene.bones.size()) + 1};
}

RunSize estimated_size(const Scene& scene, int frames, bool with_fibers, RunLayout layout) {
  if (layout == RunLayout::compact) return compact_size(scene, frames, with_fibers);
  RunSize frame;
  for (const Bone& bone : scene.bones) frame.bytes += surface_bytes(bone.surface);
  frame.files += static_cast<std::int64_t>(scene.bones.size());
  for (const Muscle& muscle : scene.muscles) {
    frame.bytes += surface_bytes(muscle.surface) + measures_bytes;
    ++frame.files;
    if (!with_fibers || muscle.fibers.count == 0) continue;
    frame.bytes += written_fibers(scene, muscle).bytes();
    ++frame.files;
  }
  return {frame.bytes * frames, frame.files * frames};
}

double correction_bytes(const Scene& scene) {
  double vertices = 0;
  for (const Muscle& muscle : scene.muscles) vertices += muscle.surface.vertex_count();
  return vertex_bytes * vertices * static_cast<double>(constraint_table().size());
}

std::string size_text(double bytes) {
  if (bytes >= 1e9) return fmt::format("{:.1f} GB", bytes / 1e9);
  if (bytes >= 1e6) return fmt::format("{:.0f} MB", bytes / 1e6);
  return fmt::format("{:.0f} kB", bytes / 1e3);
}

std::string duration_text(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace gracilis
