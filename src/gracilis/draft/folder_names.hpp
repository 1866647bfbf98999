#pragma once

#include <gracilis/draft/name_search.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gracilis {

/// What a surface's file is, as far as its name and its folders tell.
enum class NamedKind { bone, muscle, patch, unknown, something_else };

/// A file of a surface, and what its name says.
struct NamedSurfaceFile {
  std::filesystem::path file;
  NamedKind kind = NamedKind::unknown;
  NameWords words;
  NameMatch<KnownBone> bone;
  NameMatch<KnownMuscle> muscle;
};

/// Files below a folder that are surfaces, and those that may be tables of landmarks; run folders are passed over.
struct FolderFiles {
  std::vector<NamedSurfaceFile> surfaces;
  std::vector<std::filesystem::path> tables;
};

/// Throws InputError where the folder cannot be read.
FolderFiles list_folder(const std::filesystem::path& folder);

/// The same of single files, told apart by their names and the folder that each lies in; `bones` are bones whatever
/// they are called.
FolderFiles list_files(const std::vector<std::filesystem::path>& files,
                       const std::vector<std::filesystem::path>& bones = {});

}  // namespace gracilis
