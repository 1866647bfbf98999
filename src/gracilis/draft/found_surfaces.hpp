#pragma once

#include <gracilis/draft/folder_names.hpp>
#include <gracilis/geometry/triangle_mesh.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// A folder of surfaces, told apart by their names and the folders they lie in.
namespace gracilis {

/// A surface in the place of one that a run would refuse, or take with its flaws.
struct MendedSurface {
  TriangleMesh mesh;
  std::vector<std::string> repairs = {};  ///< a clause each
  std::vector<TriangleMesh> heads = {};   ///< of which it was united, where each is to be a muscle of its own
  std::string why = {};                   ///< what was wrong
  bool refused = true;                    ///< by a run; else a run would take it
  std::filesystem::path file = {};        ///< where it is written, in metres and, of a mirrored body, mirrored
};

/// Mends the surface (m) of a muscle of this name. Throws InputError where it cannot.
using MendFunction = std::function<MendedSurface(const std::string& name, const TriangleMesh& mesh)>;

/// A surface of a bone.
struct FoundBone {
  std::string name;  ///< in the scene
  std::filesystem::path file;
  std::string part = {};             ///< of a .glb; empty: the whole file
  const KnownBone* known = nullptr;  ///< null: a bone by its folder alone
  BodySide side = BodySide::none;
  Real certainty = 0;  ///< of its being that
  TriangleMesh mesh = {};
};

/// A closed surface of a muscle.
struct FoundMuscle {
  std::string name;
  std::filesystem::path file;
  std::string part = {};
  const KnownMuscle* known = nullptr;  ///< null: a muscle by its folder or its shape alone
  BodySide side = BodySide::none;
  Real certainty = 0;
  TriangleMesh mesh = {};
  std::optional<MendedSurface> mended = {};  ///< without its mesh, which is `mesh`
  std::string unmended = {};                 ///< flaws that stay though they were to be mended, and why
};

/// An open surface on bones that says where a muscle attaches.
struct FoundPatch {
  std::filesystem::path file;
  std::string part = {};
  std::string muscle;  ///< name in the scene
  const KnownMuscle* known = nullptr;
  BodySide side = BodySide::none;
  std::vector<std::string> words;
  TriangleMesh mesh = {};
};

struct FoundFolder {
  std::vector<FoundBone> bones;
  std::vector<FoundMuscle> muscles;
  std::vector<FoundPatch> patches;
  std::vector<std::filesystem::path> tables;  ///< .csv, perhaps of landmarks
  BodySide side = BodySide::right;            ///< of paired things whose names do not say
  bool side_is_guessed = false;
  std::string unit = "m";
  Real unit_length = 1;               ///< m
  Real size = 1;                      ///< of the bones against those of a grown person
  bool is_mirrored = false;           ///< as mirror_body leaves it
  std::vector<std::string> left_out;  ///< a line each: what was not taken, why, and what to do
};

/// Reads all surfaces below the folder. The unit is that in which the known bones are about as large as a grown
/// person's. What a run would refuse is mended, where there is `mend` and it can, or left out;
/// what a run takes though it cuts itself, or has pieces in others, is mended where that cures it. Throws InputError
/// where the folder cannot be read, holds no bone whose name is known, or bones of no possible size.
FoundFolder find_surfaces(const std::filesystem::path& folder);

/// The same of files listed; `subject` names them in messages. With a `unit` ("m", "cm" or "mm") sizes are not asked,
/// and no bone need be known.
FoundFolder find_surfaces(const FolderFiles& files, const std::filesystem::path& subject, const std::string& unit = "",
                          const MendFunction& mend = {});

/// The name that a bone, muscle or patch goes by in its folder: that of its file, or of its part of one.
template <class Found>
std::string name_in_folder(const Found& found) {
  return found.part.empty() ? found.file.stem().string() : found.part;
}

/// Makes a left half of a right one, or the other way: surfaces, sides and names. `right` is the body's.
void mirror_body(FoundFolder& found, const Vec3& right);

}  // namespace gracilis
