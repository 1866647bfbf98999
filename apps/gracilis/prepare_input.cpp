#include "prepare_input.hpp"

#include <gracilis/core/whole_number.hpp>
#include <gracilis/geometry/mesh_pieces.hpp>
#include <gracilis/io/mesh/load_surface.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/io/scene/preparation.hpp>

#ifdef GRACILIS_WITH_PREPARE
#include <gracilis/prepare/estimates.hpp>
#include <gracilis/prepare/surface_repair.hpp>
#endif

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace gracilis {

namespace fs = std::filesystem;

std::string option_name(const Setting<PrepareSettings>& setting) {
  std::string name(setting.key);
  std::replace(name.begin(), name.end(), '_', '-');
  return "--" + name;
}

bool is_of_scene(const PrepareOptions& options) {
  return options.files.size() == 1 && options.files.front().extension() == ".toml";
}

void stop_at(const std::vector<Problem>& problems, const PrepareOptions& options) {
  if (!problems.empty() && !options.keep_going) throw InputError(problems);
}

#ifdef GRACILIS_WITH_PREPARE

namespace {

Real unit_length(const std::string& unit) { return unit == "mm" ? 0.001 : unit == "cm" ? 0.01 : 1; }

/// Options that the input has no use for are refused: nobody would see that they do nothing.
void require_fitting(const PrepareOptions& options) {
  std::vector<Problem> problems;
  const auto refuse = [&](bool given, const char* option, const std::string& remedy) {
    const char* what = is_of_scene(options) ? "is for files of surfaces, and this is a scene"
                                            : "is for a scene, and these are files of surfaces";
    if (given) problems.push_back({"", option, what, remedy});
  };
  if (is_of_scene(options)) {
    refuse(options.split, "--split", "give the muscles' files in the place of the scene");
    refuse(options.merge, "--merge", "give the muscles' files in the place of the scene");
    refuse(options.largest, "--largest", "write piece = \"largest\" at the muscle in the scene");
    refuse(!options.bones.empty(), "--bone", "add the bone to the scene, as [[bones]]");
    refuse(!options.parts.empty(), "--part",
           "write part = \"" + (options.parts.empty() ? "" : options.parts.front()) + "\" beside 'file' in the scene");
    refuse(!options.unit.empty(), "--unit", "write unit = \"" + options.unit + "\" beside 'file' in the scene");
  } else {
    refuse(!options.scene.data.empty(), "--data", "give the path of each file");
    refuse(!options.scene.only.empty(), "--only", "give only the files that are wanted");
  }
  if (!problems.empty()) throw ConfigurationError(std::move(problems));
}

void add_problems(const InputError& error, std::vector<Problem>& problems) {
  problems.insert(problems.end(), error.problems().begin(), error.problems().end());
}

/// Bad units and empty files are told of before any work.
TriangleMesh read_sized(MeshFiles& files, const fs::path& file, const std::string& part, Real unit) {
  TriangleMesh mesh = files.read(file, unit, part);
  std::vector<Problem> problems = fatal_problems(inspect_mesh(mesh), unit, with_part(file.string(), part));
  if (!problems.empty()) throw InputError(std::move(problems));
  return mesh;
}

/// Surfaces under the names of their files, or of the parts that are wanted of each; two of one name are told apart by
/// a number. What is wrong with files, which are left out then, is added to `problems`.
std::vector<NamedSurface> read_surfaces(const std::vector<fs::path>& files, const std::vector<std::string>& parts,
                                        Real unit, std::vector<Problem>& problems) {
  MeshFiles meshes;
  std::vector<NamedSurface> surfaces;
  std::map<std::string, int> times;
  const auto add = [&](const fs::path& file, const std::string& part) {
    const std::string name = part.empty() ? file.stem().string() : part;
    const int time = ++times[name];
    try {
      TriangleMesh mesh = read_sized(meshes, file, part, unit);
      surfaces.push_back({time == 1 ? name : fmt::format("{}_{}", name, time), std::move(mesh)});
    } catch (const InputError& error) {
      add_problems(error, problems);
    }
  };
  for (const fs::path& file : files) {
    if (parts.empty()) add(file, "");
    for (const std::string& part : parts) add(file, part);
  }
  return surfaces;
}

/// Closed pieces of the surface, mended; heads that cut each other stay apart where `by_heads`.
std::vector<TriangleMesh> mended_pieces(const NamedSurface& surface, const PrepareSettings& settings, bool by_heads) {
  try {
    FixedSurface fixed = fix_surface(surface.mesh, surface.name, TimeLimit(settings.time_limit));
    return by_heads && !fixed.heads.empty() ? std::move(fixed.heads) : pieces_of(fixed.mesh);
  } catch (const OutOfTime&) {
    throw InputError(out_of_time(surface.name, settings));
  }
}

/// One surface of all, or one of each closed piece, as asked for; pieces are known only of surfaces that are mended.
/// What cannot be mended is left out, and told of in `problems`.
std::vector<NamedSurface> rearranged(std::vector<NamedSurface> surfaces, const PrepareOptions& options,
                                     const PrepareSettings& settings, std::vector<Problem>& problems) {
  for (NamedSurface& surface : surfaces) surface.largest_piece = options.largest;
  if (!options.merge && !options.split) return surfaces;
  std::vector<TriangleMesh> all;
  std::vector<NamedSurface> parts;
  for (const NamedSurface& surface : surfaces) try {
      int number = 0;
      for (TriangleMesh& piece : mended_pieces(surface, settings, !options.merge)) {
        if (options.merge)
          all.push_back(std::move(piece));
        else
          parts.push_back({fmt::format("{}_{}", surface.name, ++number), std::move(piece), false});
      }
    } catch (const InputError& error) {
      add_problems(error, problems);
    }
  if (!options.merge || all.empty()) return parts;
  const TimeLimit limit(settings.time_limit * static_cast<Real>(surfaces.size()));
  const std::vector<TriangleMesh> whole = united(std::move(all), limit).pieces;
  if (!options.split) return {{"merged", merged(whole), options.largest}};
  for (const TriangleMesh& piece : whole) parts.push_back({fmt::format("merged_{}", parts.size() + 1), piece, false});
  return parts;
}

void set_given(PrepareSettings& settings, const PrepareOptions& options) {
  for (const auto& [key, value] : options.settings) {
    const Setting<PrepareSettings>& setting = *find_setting<PrepareSettings>(key);
    const Real* number = std::get_if<Real>(&value);
    const std::optional<int> count =
        number && setting.kind == SettingKind::integer ? whole_number<int>(*number) : std::nullopt;
    // What is no count is refused as the number that it is.
    const std::string wrong = assign(settings, setting, count ? SettingValue(*count) : value);
    if (!wrong.empty()) throw ConfigurationError({"", option_name(setting), wrong, ""});
  }
}

SceneSurfaces surfaces_asked_for(const PrepareOptions& options, std::vector<Problem>& problems) {
  if (is_of_scene(options)) {
    SceneSurfaces scene = read_scene_surfaces(options.files.front(), options.scene);
    set_given(scene.settings, options);
    return scene;
  }
  SceneSurfaces input;
  set_given(input.settings, options);
  const Real unit = unit_length(options.unit);
  std::vector<NamedSurface> muscles = read_surfaces(options.files, options.parts, unit, problems);
  const std::size_t of_muscles = problems.size();
  input.bones = read_surfaces(options.bones, {}, unit, problems);
  // Without a bone muscles would be left lying in it, and nothing would say so.
  if (problems.size() > of_muscles) throw InputError(std::move(problems));
  stop_at(problems, options);
  input.muscles = rearranged(std::move(muscles), options, input.settings, problems);
  stop_at(problems, options);
  return input;
}

}  // namespace

SceneSurfaces read_input(const PrepareOptions& options, std::vector<Problem>& problems) {
  require_fitting(options);
  SceneSurfaces input = surfaces_asked_for(options, problems);
  if (!options.apart.empty() && input.settings.keep_overlaps)
    throw ConfigurationError(
        {"", "--apart", "pulls muscles apart, and overlaps are to be kept", "leave out one of the two"});
  pull_only_known(input.muscles, options.apart, "--apart");  // in the place of what a scene says
  return input;
}

#endif

}  // namespace gracilis
