#include <gracilis/opensim/import/bone_files.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/io/parse_toml.hpp>
#include <gracilis/opensim/reader/model_file.hpp>
#include <gracilis/scene/names.hpp>

#include <fmt/format.h>
#include <toml++/toml.h>

namespace gracilis::opensim {

namespace fs = std::filesystem;

static Real unit_named(const fs::path& path, const std::string& unit) {
  if (unit == "m") return 1;
  if (unit == "cm") return 0.01;
  if (unit == "mm") return 0.001;
  throw InputError({path.string(), "", fmt::format("'{}' is no unit", unit), "use \"m\", \"cm\" or \"mm\""});
}

std::map<std::string, GeometryFiles> read_geometry_map(const fs::path& path) {
  require_readable_file(path);
  std::map<std::string, GeometryFiles> map;
  try {
    const toml::table table = parse_toml(read_text(path), path.string());
    for (const auto& [key, node] : table) {
      GeometryFiles& entry = map[std::string(key.str())];
      const toml::table* described = node.as_table();
      if (described)
        if (const auto unit = (*described)["unit"].value<std::string>()) entry.unit = unit_named(path, *unit);
      if (described) entry.like = (*described)["like"].value_or(std::string());
      const auto add = [&](const std::string& file) { entry.files.push_back(file_beside(path, file)); };
      const toml::node* files = described ? described->get("files") : &node;
      if (files && files->is_string()) add(files->ref<std::string>());
      if (files && files->is_array())
        for (const toml::node& file : *files->as_array()) add(file.value_or<std::string>(""));
      if (entry.files.empty())
        throw InputError({path.string(), std::string(key.str()), "names no file", "give a file or a list of files"});
    }
  } catch (const toml::parse_error& error) {
    throw InputError({path.string(), std::to_string(error.source().begin.line), std::string(error.description()), ""});
  }
  return map;
}

/// The first place below which the file lies; empty when it lies nowhere.
static fs::path find_surface(const std::string& file, const GeometryPlaces& places) {
  std::vector<fs::path> folders = places.folders;
  folders.push_back(places.model_folder);
  folders.push_back(places.model_folder / "Geometry");
  const fs::path relative = fs::path(file).lexically_normal();
  const bool below = !relative.is_absolute() && file.find(':') == std::string::npos && *relative.begin() != "..";
  for (const fs::path& folder : folders) {
    if (below && fs::is_regular_file(folder / relative)) return folder / relative;
    if (fs::is_regular_file(folder / relative.filename())) return folder / relative.filename();
  }
  return {};
}

static GeometryFiles files_for(const Geometry& geometry, const GeometryPlaces& places) {
  for (const std::string& name : {geometry.file, fs::path(geometry.file).filename().string()})
    if (const auto found = places.named.find(name); found != places.named.end()) return found->second;
  const fs::path file = find_surface(geometry.file, places);
  return file.empty() ? GeometryFiles{} : GeometryFiles{{file}, 0};
}

ModelBones load_bones(const Model& model, const std::vector<RigidTransform>& poses, const GeometryPlaces& places) {
  ModelBones result;
  std::set<std::string> taken;
  for (std::size_t body = 1; body < model.bodies.size(); ++body) {
    for (const Geometry& geometry : model.bodies[body].geometry) {
      const GeometryFiles files = files_for(geometry, places);
      if (files.files.empty())
        result.missing.push_back(
            fmt::format("body '{}': its surface '{}' is not found", model.bodies[body].name, geometry.file));
      for (const fs::path& file : files.files) {
        try {
          ModelBone bone;
          bone.body = static_cast<Index>(body);
          bone.surface = read_mesh(file, 1);
          const Vec3 scale = files.unit > 0 ? Vec3::Constant(files.unit) : geometry.scale;
          bone.surface.vertices = (poses[body] * geometry.frame) * (scale.asDiagonal() * bone.surface.vertices);
          // A mirrored surface is inside out.
          if (scale.prod() < 0) bone.surface.faces.row(1).swap(bone.surface.faces.row(2));
          bone.name = file_name_of(file.stem().string(), taken);
          result.bones.push_back(std::move(bone));
        } catch (const InputError& error) {
          result.missing.push_back(fmt::format("body '{}': {}", model.bodies[body].name, error.what()));
        }
      }
    }
  }
  return result;
}

/// Where a surface that the model shows lies in the ground frame, but for its scale.
static RigidTransform place_of(const Model& model, const std::vector<RigidTransform>& poses, const std::string& muscle,
                               const std::string& surface) {
  for (std::size_t body = 0; body < model.bodies.size(); ++body)
    for (const Geometry& geometry : model.bodies[body].geometry)
      if (geometry.file == surface || fs::path(geometry.file).filename() == surface)
        return poses[body] * geometry.frame;
  throw InputError({model.name, muscle, fmt::format("lies like '{}', which the model does not show", surface),
                    "name the surface of a bone as the model does"});
}

std::map<std::string, TriangleMesh> load_muscle_surfaces(const Model& model, const std::vector<RigidTransform>& poses,
                                                         const std::map<std::string, GeometryFiles>& files) {
  std::map<std::string, TriangleMesh> surfaces;
  for (const auto& [muscle, entry] : files) {
    if (index_of(model.muscles, muscle) < 0)
      throw InputError({model.name, muscle, "is no muscle of the model", "name one of its muscles"});
    if (entry.files.size() != 1) throw InputError({model.name, muscle, "needs one surface", "join the files"});
    TriangleMesh& surface = surfaces[muscle] = read_mesh(entry.files[0], entry.unit > 0 ? entry.unit : 1);
    if (!entry.like.empty()) surface.vertices = place_of(model, poses, muscle, entry.like) * surface.vertices;
  }
  return surfaces;
}

}  // namespace gracilis::opensim
