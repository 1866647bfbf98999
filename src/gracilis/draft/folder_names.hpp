#pragma once

#include <gracilis/draft/name_search.hpp>
#include <gracilis/io/mesh/mesh_reader.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace gracilis {

/// What a surface's file is, as far as its name and its folders tell.
enum class NamedKind { bone, muscle, patch, unknown, something_else };

/// A file of a surface, or one of its parts, and what its name says.
struct NamedSurfaceFile {
  std::filesystem::path file;
  std::string part = {};  ///< of a .glb; empty: the whole file
  NamedKind kind = NamedKind::unknown;
  NameWords words;
  NameMatch<KnownBone> bone;
  NameMatch<KnownMuscle> muscle;
};

/// Whether its name leaves hardly a doubt that it is a bone of the dictionary, whose size is known.
inline bool is_surely_a_bone(const NamedSurfaceFile& surface) {
  return surface.kind == NamedKind::bone && surface.bone.known && surface.bone.certainty >= 0.7;
}

/// Surfaces below a folder, each mesh of a .glb by itself, and files that may be tables of landmarks; folders of runs,
/// and of surfaces that a drafted scene had mended, are passed over.
struct FolderFiles {
  std::vector<NamedSurfaceFile> surfaces;
  std::vector<std::filesystem::path> tables;
  std::vector<std::string> unreadable = {};                           ///< a line for each file
  std::shared_ptr<MeshFiles> meshes = std::make_shared<MeshFiles>();  ///< which the surfaces are read from
};

/// How a drafted scene's file begins, by which it is told from one written by hand.
inline constexpr const char* drafted_scene_mark = "# Made by gracilis from surfaces.";

/// Where a drafted scene puts the surfaces that it had mended.
std::filesystem::path mended_folder(const std::filesystem::path& scene);

/// Throws InputError where the folder cannot be read.
FolderFiles list_folder(const std::filesystem::path& folder);

/// The same of single files, told apart by their names and the folder that each lies in; `bones` are bones whatever
/// they are called.
FolderFiles list_files(const std::vector<std::filesystem::path>& files,
                       const std::vector<std::filesystem::path>& bones = {});

}  // namespace gracilis
