#include <gracilis/draft/found_surfaces.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/median.hpp>
#include <gracilis/core/shell_word.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mirrored_mesh.hpp>
#include <gracilis/io/mesh/load_surface.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>
#include <gracilis/scene/names.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace gracilis {
namespace {

namespace fs = std::filesystem;

struct Unit {
  const char* name;
  Real length;
};
constexpr std::array<Unit, 3> units = {{{"m", 1}, {"cm", 0.01}, {"mm", 0.001}}};

/// Grown people's bones are 0.75 to 1.3 times as long as the dictionary says, a newborn's 0.25.
constexpr Real smallest_size = 0.22, largest_size = 1.8;

/// m³, of a grown person: a quadriceps in one piece has two thirds of it.
constexpr Real largest_muscle = 0.003;

Real largest_extent(const Points& points) {
  if (points.cols() == 0) return 0;
  return bounding_box(points).sizes().maxCoeff();
}

/// Half of the bones are this much larger than those of a grown person, were the files in metres.
Real median_size(const FolderFiles& files) {
  std::vector<Real> ratios;
  for (const NamedSurfaceFile& each : files.surfaces) {
    if (each.kind != NamedKind::bone || !each.bone.known || each.bone.certainty < 0.7) continue;
    try {
      const Real ratio = largest_extent(read_mesh(each.file, 1).vertices) / each.bone.known->length;
      if (ratio > 0 && std::isfinite(ratio)) ratios.push_back(ratio);
    } catch (const InputError&) {
      continue;  // said where the surface is read for its use
    }
  }
  return median(std::move(ratios));
}

void choose_unit(const FolderFiles& files, const fs::path& folder, FoundFolder& found) {
  const Real size = median_size(files);
  if (size == 0) {
    throw InputError({folder.string(), "", "holds no bone whose name is known",
                      "name bones as in femur_r.ply or 'left scapula.stl', in English or Latin, with _r or _l"});
  }
  const auto off = [&](const Unit& unit) { return std::abs(std::log(size * unit.length)); };
  const Unit& best =
      *std::min_element(units.begin(), units.end(), [&](const Unit& a, const Unit& b) { return off(a) < off(b); });
  found.unit = best.name;
  found.unit_length = best.length;
  found.size = size * best.length;
  if (found.size >= smallest_size && found.size <= largest_size) return;
  throw InputError(
      {folder.string(), "",
       fmt::format("the bones are {:.3g} times as large as a grown person's in {}, and in no unit of m, cm "
                   "and mm as large as bones are",
                   found.size, best.name),
       "scale the surfaces to one of these units"});
}

/// The unit as given.
void take_unit(const FolderFiles& files, const std::string& name, FoundFolder& found) {
  for (const Unit& unit : units)
    if (unit.name == name) found.unit_length = unit.length;
  found.unit = name;
  if (const Real size = median_size(files); size > 0) found.size = size * found.unit_length;
}

/// What both sides of one name are told apart by.
BodySide usual_side(const FolderFiles& files, bool& is_guessed) {
  int right = 0, left = 0;
  for (const NamedSurfaceFile& each : files.surfaces) {
    right += each.words.side == BodySide::right;
    left += each.words.side == BodySide::left;
  }
  is_guessed = right == 0 && left == 0;
  return left > right ? BodySide::left : BodySide::right;
}

/// The name in the scene: the known one, what else its file's name says, and its side.
std::string scene_name(const std::string& known, const std::vector<std::string>& rest, BodySide side) {
  std::string name = known;
  for (const std::string& word : rest) name += (name.empty() ? "" : "_") + word;
  return file_name_of(name + side_ending(side));
}

std::string advice(const fs::path& file, const std::string& unit) {
  return fmt::format("mend it with: gracilis prepare {} --unit {} --out prepared, and put what comes out in its place",
                     shell_word(file.string()), unit);
}

/// Takes surfaces one by one.
struct Taking {
  FoundFolder& found;
  const FolderFiles& files;
  std::map<std::string, fs::path> taken = {};  ///< names

  bool is_new(const std::string& name, const fs::path& file) {
    const auto [at, inserted] = taken.emplace(name, file);
    if (!inserted)
      found.left_out.push_back(fmt::format("{}: {} is there already, from {}; remove or rename one", file.string(),
                                           name, at->second.string()));
    return inserted;
  }

  /// Of two that have the same name but for a side, the one without it is on the other side.
  BodySide side_of(const NamedSurfaceFile& surface, bool paired) const {
    if (surface.words.side != BodySide::none) return surface.words.side;
    for (const NamedSurfaceFile& other : files.surfaces)
      if (other.words.side != BodySide::none && other.words.words == surface.words.words)
        return other_side(other.words.side);
    return paired ? found.side : BodySide::none;
  }

  /// Nothing where a run would refuse it.
  std::optional<TriangleMesh> load(const fs::path& file, SurfaceRole role) {
    try {
      return load_surface(file, found.unit_length, role).mesh;
    } catch (const InputError& error) {
      const Problem& first = error.problems().front();
      const bool mends = role == SurfaceRole::muscle && !first.remedy.starts_with("set unit");
      found.left_out.push_back(fmt::format("{}: a run would refuse it: {}; {}", file.string(), first.what,
                                           mends ? advice(file, found.unit) : first.remedy));
      return std::nullopt;
    }
  }

  void take_bone(const NamedSurfaceFile& each) {
    const KnownBone* known = each.bone.known;
    const BodySide side = side_of(each, known && known->paired);
    const std::string name =
        known ? scene_name(known->name, each.bone.rest, side) : scene_name("", each.words.words, each.words.side);
    std::optional<TriangleMesh> mesh = load(each.file, SurfaceRole::bone);
    if (!mesh || !is_new(name, each.file)) return;
    found.bones.push_back({name, each.file, known, side, known ? each.bone.certainty : 0.3, std::move(*mesh)});
  }

  std::string muscle_name(const NamedSurfaceFile& each, bool with_rest) const {
    const KnownMuscle* known = each.muscle.known;
    if (!known) return scene_name("", each.words.words, each.words.side);
    return scene_name(known->name, with_rest ? each.muscle.rest : std::vector<std::string>{}, side_of(each, true));
  }

  void take_muscle(const NamedSurfaceFile& each) {
    const std::string name = muscle_name(each, true);
    std::optional<TriangleMesh> mesh = load(each.file, SurfaceRole::muscle);
    if (!mesh || !is_new(name, each.file)) return;
    const KnownMuscle* known = each.muscle.known;
    found.muscles.push_back(
        {name, each.file, known, side_of(each, true), known ? each.muscle.certainty : 0.3, std::move(*mesh)});
  }

  /// By its shape: a closed surface no larger than a muscle may be one, which its ends on bones must show.
  void take_unknown(const NamedSurfaceFile& each) {
    std::optional<TriangleMesh> mesh;
    try {
      mesh = load_surface(each.file, found.unit_length, SurfaceRole::muscle).mesh;
    } catch (const InputError&) {
      mesh.reset();
    }
    const std::string name = scene_name("", each.words.words, each.words.side);
    const Real largest = largest_muscle * std::pow(found.size, 3);
    if (mesh && enclosed_volume(mesh->vertices, mesh->faces) < largest && is_new(name, each.file)) {
      found.muscles.push_back({name, each.file, nullptr, each.words.side, 0.2, std::move(*mesh)});
      return;
    }
    found.left_out.push_back(
        fmt::format("{}: its name is unknown; rename it to a bone's or a muscle's, as femur_r or gluteus_maximus_r, or "
                    "put it into a folder 'bones' or 'muscles'",
                    each.file.string()));
  }

  void take_patch(const NamedSurfaceFile& each) {
    if (!each.muscle.known) {
      found.left_out.push_back(
          fmt::format("{}: a patch of no muscle whose name is known; name it after its muscle", each.file.string()));
      return;
    }
    try {
      found.patches.push_back({each.file, muscle_name(each, false), each.muscle.known, side_of(each, true),
                               each.muscle.rest, read_mesh(each.file, found.unit_length)});
    } catch (const InputError& error) {
      found.left_out.push_back(error.what());
    }
  }
};

}  // namespace

void mirror_body(FoundFolder& found, const Vec3& right) {
  const auto turn = [&](auto& each) {
    const std::string before = side_ending(each.side);
    each.side = other_side(each.side);
    if (!before.empty() && each.name.ends_with(before))
      each.name.replace(each.name.size() - 2, 2, side_ending(each.side));
    each.mesh = mirrored(each.mesh, right);
  };
  for (FoundBone& bone : found.bones) turn(bone);
  for (FoundMuscle& muscle : found.muscles) turn(muscle);
  for (FoundPatch& patch : found.patches) {
    if (patch.muscle.ends_with("_r") || patch.muscle.ends_with("_l"))
      patch.muscle.back() = patch.muscle.back() == 'r' ? 'l' : 'r';
    patch.side = other_side(patch.side);
    patch.mesh = mirrored(patch.mesh, right);
  }
  found.side = other_side(found.side);
  found.is_mirrored = !found.is_mirrored;
}

FoundFolder find_surfaces(const fs::path& folder) { return find_surfaces(list_folder(folder), folder); }

FoundFolder find_surfaces(const FolderFiles& files, const fs::path& subject, const std::string& unit) {
  FoundFolder found;
  found.tables = files.tables;
  if (unit.empty())
    choose_unit(files, subject, found);
  else
    take_unit(files, unit, found);
  found.side = usual_side(files, found.side_is_guessed);
  Taking taking{found, files};
  for (const NamedSurfaceFile& each : files.surfaces) {
    if (each.kind == NamedKind::bone) taking.take_bone(each);
    if (each.kind == NamedKind::muscle) taking.take_muscle(each);
    if (each.kind == NamedKind::patch) taking.take_patch(each);
    if (each.kind == NamedKind::something_else)
      found.left_out.push_back(fmt::format("{}: by its name neither bone nor muscle", each.file.string()));
    if (each.kind == NamedKind::unknown) taking.take_unknown(each);
  }
  return found;
}

}  // namespace gracilis
