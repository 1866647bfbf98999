#include <gracilis/io/scene/surfaces.hpp>

#include <gracilis/geometry/box_mesh.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_pieces.hpp>
#include <gracilis/geometry/mirrored_mesh.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/io/scene/files.hpp>

#include <algorithm>
#include <limits>

namespace gracilis::sections {

namespace fs = std::filesystem;

static constexpr long most_box_triangles = 2'000'000;

static BoxDescription read_box(TomlReader table) {
  const Vec3 center = table.vector("center_mm").value_or(Vec3::Zero()) / 1000;
  const Vec3 size = table.required_vector("size_mm").value_or(Vec3::Ones()) / 1000;
  const Vec3 cells = table.vector("cells").value_or(Vec3::Ones());
  if (!(size.minCoeff() > 0)) table.add_problem("size_mm", "'size_mm' must be three numbers above 0");
  const bool are_counts = cells.minCoeff() >= 1 && cells.maxCoeff() <= 1000 && cells == cells.array().round().matrix();
  if (!are_counts) table.add_problem("cells", "'cells' must be three integers from 1 to 1000");
  const Real triangles = 4 * (cells[0] * cells[1] + cells[1] * cells[2] + cells[2] * cells[0]);
  if (are_counts && triangles > most_box_triangles)
    table.add_problem("cells", "'cells' asks for " + std::to_string(static_cast<long>(triangles)) + " triangles",
                      std::to_string(most_box_triangles) + " are the most that are made");
  table.reject_unknown_keys();
  const auto count = [&](int k) { return are_counts ? static_cast<int>(cells[k]) : 1; };
  return {center - size / 2, center + size / 2, {count(0), count(1), count(2)}};
}

SurfaceDescription read_surface(TomlReader& table) {
  SurfaceDescription surface;
  if (std::optional<TomlReader> box = table.table("box")) {
    if (table.has("file")) table.add_problem("file", "the surface is given twice, by 'file' and by 'box'");
    surface.box = read_box(std::move(*box));
  } else if (table.has("given")) {
    surface.given = table.integer("given", 0, std::numeric_limits<Index>::max()).value_or(0);
    surface.file.path = table.text("name").value_or("");  // stands for the file in messages
    surface.file.place = table.place();
  } else {
    surface.file = surface_file(table, table.required_text("file"));
  }
  return surface;
}

NamedFile surface_file(TomlReader& table, const std::string& path) {
  NamedFile file = named_file(table, path);
  file.mirror = table.flag("mirror").value_or(false);
  file.part = table.text("part").value_or("");
  return file;
}

void mirror_if_asked(const SceneInProgress& progress, const NamedFile& file, TriangleMesh& mesh) {
  if (file.mirror) mesh = mirrored(mesh, progress.description.scene.axes.right());
}

bool any_point_within(const TriangleMesh& surface, const Points& points) {
  const Eigen::AlignedBox3d box = bounding_box(surface.vertices);
  for (Index i = 0; i < static_cast<Index>(points.cols()); ++i)
    if (box.contains(points.col(i))) return true;
  return false;
}

SurfaceLoader::SurfaceLoader(SceneInProgress& progress, bool muscles_stay_raw)
    : progress_(progress), muscles_stay_raw_(muscles_stay_raw) {
  std::vector<const SurfaceDescription*> surfaces;
  std::vector<SurfaceFile> files;
  const auto add = [&](const SurfaceDescription& surface, SurfaceRole role) {
    if (surface.box || surface.given || stays_raw(surface, role)) return;
    const fs::path path = located(progress, surface.file);
    if (path.empty()) return;
    surfaces.push_back(&surface);
    files.push_back({path, surface.file.unit, role, surface.largest_piece, surface.file.part});
  };
  for (const BoneDescription& bone : progress.description.bones) add(bone.surface, SurfaceRole::bone);
  for (const MuscleDescription& muscle : progress.description.muscles) add(muscle.surface, SurfaceRole::muscle);
  std::vector<LoadOutcome> outcomes = load_surfaces(files, *progress.files);
  for (std::size_t i = 0; i < files.size(); ++i) loaded_[surfaces[i]] = std::move(outcomes[i]);
}

bool SurfaceLoader::stays_raw(const SurfaceDescription& surface, SurfaceRole role) const {
  return role == SurfaceRole::muscle && muscles_stay_raw_ && !surface.box;
}

bool SurfaceLoader::take_given(const SurfaceDescription& surface, SurfaceRole role, TriangleMesh& mesh) {
  mesh = progress_.surfaces[static_cast<std::size_t>(*surface.given)];
  if (stays_raw(surface, role)) return false;
  try {
    LoadedMesh loaded =
        check_surface(surface.largest_piece ? largest_piece(mesh) : mesh, surface.file.unit, role, surface.file.path);
    mesh = std::move(loaded.mesh);
    progress_.add_warnings(loaded.repairs);
    progress_.add_warnings(loaded.warnings);
    return !loaded.repairs.empty();
  } catch (const InputError& error) {
    progress_.problems.insert(progress_.problems.end(), error.problems().begin(), error.problems().end());
    return false;
  }
}

bool SurfaceLoader::take(const SurfaceDescription& surface, SurfaceRole role, TriangleMesh& mesh) {
  if (surface.box) {
    mesh = box_mesh(surface.box->low, surface.box->high, surface.box->cells);
    return false;
  }
  if (surface.given) return take_given(surface, role, mesh);
  bool repaired = false;
  read_file(progress_, surface.file, [&](const fs::path& path) {
    if (stays_raw(surface, role)) {
      mesh = progress_.files->read(path, surface.file.unit, surface.file.part);
      mirror_if_asked(progress_, surface.file, mesh);
      return;
    }
    LoadOutcome& outcome = loaded_.at(&surface);
    if (outcome.error) throw InputError(*outcome.error);
    mesh = std::move(outcome.loaded.mesh);
    mirror_if_asked(progress_, surface.file, mesh);
    repaired = !outcome.loaded.repairs.empty();
    progress_.add_warnings(outcome.loaded.repairs);
    progress_.add_warnings(outcome.loaded.warnings);
  });
  return repaired;
}

}  // namespace gracilis::sections
