#include <gracilis/draft/found_surfaces.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/shell_word.hpp>
#include <gracilis/draft/folder_unit.hpp>
#include <gracilis/draft/muscle_heads.hpp>
#include <gracilis/draft/surface_flaws.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/mesh_pieces.hpp>
#include <gracilis/geometry/mirrored_mesh.hpp>
#include <gracilis/io/mesh/load_surface.hpp>
#include <gracilis/scene/names.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace gracilis {
namespace {

namespace fs = std::filesystem;

/// m³, of a grown person: a quadriceps in one piece has two thirds of it.
constexpr Real largest_muscle = 0.003;

/// Of a muscle's volume: mending that takes more away than where triangles cut others does harm.
constexpr Real least_kept = 0.95;

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

/// How messages name it.
std::string title(const NamedSurfaceFile& surface) { return with_part(surface.file.string(), surface.part); }

std::string advice(const NamedSurfaceFile& surface, const std::string& unit) {
  return fmt::format(
      "mend it by --prepare, or with: gracilis prepare {}{} --unit {} --out prepared, and put what comes out in its "
      "place",
      shell_word(surface.file.string()), surface.part.empty() ? "" : " --part " + shell_word(surface.part), unit);
}

/// Takes surfaces one by one.
struct Taking {
  FoundFolder& found;
  const FolderFiles& files;
  const MendFunction& mend;
  std::map<std::string, std::string> taken = {};  ///< by names, from where

  bool is_free(const std::string& name, const NamedSurfaceFile& each) {
    const auto at = taken.find(name);
    if (at != taken.end())
      found.left_out.push_back(
          fmt::format("{}: {} is there already, from {}; remove or rename one", title(each), name, at->second));
    return at == taken.end();
  }

  bool is_new(const std::string& name, const NamedSurfaceFile& each) {
    return is_free(name, each) && taken.emplace(name, title(each)).second;
  }

  /// Of two that have the same name but for a side, the one without it is on the other side.
  BodySide side_of(const NamedSurfaceFile& surface, bool paired) const {
    if (surface.words.side != BodySide::none) return surface.words.side;
    for (const NamedSurfaceFile& other : files.surfaces)
      if (other.words.side != BodySide::none && other.words.words == surface.words.words)
        return other_side(other.words.side);
    return paired ? found.side : BodySide::none;
  }

  TriangleMesh read(const NamedSurfaceFile& each) const {
    return files.meshes->read(each.file, found.unit_length, each.part);
  }

  TriangleMesh load(const NamedSurfaceFile& each, SurfaceRole role) const {
    return check_surface(read(each), found.unit_length, role, each.file.string(), each.part).mesh;
  }

  void leave_out(const NamedSurfaceFile& each, const Problem& refused, SurfaceRole role) {
    const bool mends = role == SurfaceRole::muscle && !refused.remedy.starts_with("set unit");
    found.left_out.push_back(fmt::format("{}: a run would refuse it: {}; {}", title(each), refused.what,
                                         mends ? advice(each, found.unit) : refused.remedy));
  }

  /// Nothing where a run would refuse it.
  std::optional<TriangleMesh> load_bone(const NamedSurfaceFile& each) {
    try {
      return load(each, SurfaceRole::bone);
    } catch (const InputError& error) {
      leave_out(each, error.problems().front(), SurfaceRole::bone);
      return std::nullopt;
    }
  }

  /// Puts what `mend` makes of the surface in its place. Throws InputError where a run would refuse that, too.
  void put_mended(const NamedSurfaceFile& each, FoundMuscle& muscle, const std::string& why) {
    MendedSurface mended = mend(muscle.name, read(each));
    muscle.mesh = check_surface(mended.mesh, 1, SurfaceRole::muscle, muscle.name).mesh;
    mended.mesh = {};
    mended.why = why;
    muscle.mended = std::move(mended);
  }

  /// What a run takes with flaws, without them; as it is, which is told, where they stay or more goes than they.
  void mend_flaws(const NamedSurfaceFile& each, FoundMuscle& muscle) {
    const std::string flaws = flaws_of(muscle.mesh);
    if (flaws.empty()) return;
    FoundMuscle other = muscle;
    try {
      put_mended(each, other, flaws);
    } catch (const InputError& error) {
      muscle.unmended = fmt::format("{}: {}", flaws, error.problems().front().what);
      return;
    }
    const TriangleMesh main = largest_piece(muscle.mesh);
    const Real kept =
        enclosed_volume(other.mesh.vertices, other.mesh.faces) / std::abs(enclosed_volume(main.vertices, main.faces));
    if (const std::string left = flaws_of(other.mesh); !left.empty())
      muscle.unmended = fmt::format("{}: mended, {}", flaws, left);
    else if (kept < least_kept)
      muscle.unmended = fmt::format("{}: mended, {:.0f} % of it would be left", flaws, 100 * kept);
    if (!muscle.unmended.empty()) return;
    other.mended->refused = false;
    muscle = std::move(other);
  }

  /// The muscle's surface, mended where a run would refuse it and that is asked for and possible.
  bool load_muscle(const NamedSurfaceFile& each, FoundMuscle& muscle) {
    Problem refused;
    try {
      muscle.mesh = load(each, SurfaceRole::muscle);
      if (mend) mend_flaws(each, muscle);
      return true;
    } catch (const InputError& error) {
      refused = error.problems().front();
    }
    if (!mend) {
      leave_out(each, refused, SurfaceRole::muscle);
      return false;
    }
    try {
      put_mended(each, muscle, refused.what);
      return true;
    } catch (const InputError& error) {
      const Problem& first = error.problems().front();
      found.left_out.push_back(fmt::format("{}: a run would refuse it: {}; nor could it be mended: {}{}", title(each),
                                           refused.what, first.what, first.remedy.empty() ? "" : "; " + first.remedy));
      return false;
    }
  }

  /// The less, the better it is: 0 of a surface that a run takes and nothing is wrong with, 2 of one that it refuses.
  int badness(const NamedSurfaceFile& each) const {
    try {
      return flaws_of(load(each, SurfaceRole::muscle)).empty() ? 0 : 1;
    } catch (const InputError&) {
      return 2;
    }
  }

  /// The surfaces in their order, but of several muscles of one name the soundest first.
  std::vector<const NamedSurfaceFile*> in_order() const {
    std::vector<const NamedSurfaceFile*> order;
    std::map<std::string, std::vector<std::size_t>> places;
    for (const NamedSurfaceFile& each : files.surfaces) {
      if (each.kind == NamedKind::muscle) places[muscle_name(each, true)].push_back(order.size());
      order.push_back(&each);
    }
    for (const auto& [name, of_name] : places) {
      if (of_name.size() < 2) continue;
      std::vector<std::pair<int, const NamedSurfaceFile*>> sorted;
      for (const std::size_t place : of_name) sorted.emplace_back(badness(*order[place]), order[place]);
      std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      for (std::size_t i = 0; i < sorted.size(); ++i) order[of_name[i]] = sorted[i].second;
    }
    return order;
  }

  void take_bone(const NamedSurfaceFile& each) {
    const KnownBone* known = each.bone.known;
    const BodySide side = side_of(each, known && known->paired);
    const std::string name =
        known ? scene_name(known->name, each.bone.rest, side) : scene_name("", each.words.words, each.words.side);
    std::optional<TriangleMesh> mesh = load_bone(each);
    if (!mesh || !is_new(name, each)) return;
    found.bones.push_back(
        {name, each.file, each.part, known, side, known ? each.bone.certainty : 0.3, std::move(*mesh)});
  }

  std::string muscle_name(const NamedSurfaceFile& each, bool with_rest) const {
    const KnownMuscle* known = each.muscle.known;
    if (!known) return scene_name("", each.words.words, each.words.side);
    return scene_name(known->name, with_rest ? each.muscle.rest : std::vector<std::string>{}, side_of(each, true));
  }

  void take_muscle(const NamedSurfaceFile& each) {
    const KnownMuscle* known = each.muscle.known;
    FoundMuscle muscle{
        muscle_name(each, true), each.file, each.part, known, side_of(each, true), known ? each.muscle.certainty : 0.3};
    // Asked before it is mended, which takes its time.
    if (is_free(muscle.name, each) && load_muscle(each, muscle) && is_new(muscle.name, each))
      found.muscles.push_back(std::move(muscle));
  }

  /// By its shape: a closed surface no larger than a muscle may be one, which its ends on bones must show.
  void take_unknown(const NamedSurfaceFile& each) {
    std::optional<TriangleMesh> mesh;
    try {
      mesh = load(each, SurfaceRole::muscle);
    } catch (const InputError&) {
      mesh.reset();
    }
    const std::string name = scene_name("", each.words.words, each.words.side);
    const Real largest = largest_muscle * std::pow(found.size, 3);
    if (mesh && enclosed_volume(mesh->vertices, mesh->faces) < largest && is_new(name, each)) {
      found.muscles.push_back({name, each.file, each.part, nullptr, each.words.side, 0.2, std::move(*mesh)});
      return;
    }
    found.left_out.push_back(
        fmt::format("{}: its name is unknown; rename it to a bone's or a muscle's, as femur_r or gluteus_maximus_r, or "
                    "put it into a folder 'bones' or 'muscles'",
                    title(each)));
  }

  void take_patch(const NamedSurfaceFile& each) {
    if (!each.muscle.known) {
      found.left_out.push_back(
          fmt::format("{}: a patch of no muscle whose name is known; name it after its muscle", title(each)));
      return;
    }
    try {
      found.patches.push_back({each.file, each.part, muscle_name(each, false), each.muscle.known, side_of(each, true),
                               each.muscle.rest, read(each)});
    } catch (const InputError& error) {
      found.left_out.push_back(error.what());
    }
  }

  void take(const NamedSurfaceFile& each) {
    if (each.kind == NamedKind::bone) take_bone(each);
    if (each.kind == NamedKind::muscle) take_muscle(each);
    if (each.kind == NamedKind::patch) take_patch(each);
    if (each.kind == NamedKind::something_else)
      found.left_out.push_back(fmt::format("{}: by its name neither bone nor muscle", title(each)));
    if (each.kind == NamedKind::unknown) take_unknown(each);
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

FoundFolder find_surfaces(const FolderFiles& files, const fs::path& subject, const std::string& unit,
                          const MendFunction& mend) {
  FoundFolder found;
  found.left_out = files.unreadable;
  found.tables = files.tables;
  set_unit(files, subject, unit, found);
  found.side = usual_side(files, found.side_is_guessed);
  Taking taking{found, files, mend};
  for (const NamedSurfaceFile* each : taking.in_order()) taking.take(*each);
  leave_out_wholes(found);
  take_heads_apart(found);
  return found;
}

}  // namespace gracilis
