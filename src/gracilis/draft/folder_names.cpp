#include <gracilis/draft/folder_names.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>

#include <algorithm>
#include <set>

namespace gracilis {
namespace {

namespace fs = std::filesystem;

const std::set<std::string> surface_endings = {".ply", ".stl", ".obj", ".vtk", ".vtp"};
const std::set<std::string> bone_folders = {"bone", "bones", "os", "ossa", "skeleton", "bony"};
const std::set<std::string> muscle_folders = {"muscle", "muscles", "musculus", "musculi", "musculature"};
const std::set<std::string> patch_words = {"patch",     "patches",    "attachment", "attachments", "origin", "origins",
                                           "insertion", "insertions", "footprint",  "footprints",  "ori",    "ins"};

/// Words as they stand, without what read_name makes of them.
std::vector<std::string> plain_words(const std::string& text) { return read_name(text, WordTables{}).words; }

bool any_in(const std::vector<std::string>& words, const std::set<std::string>& set) {
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) { return set.contains(word); });
}

NamedKind kind_of_folder(const std::string& name) {
  const std::vector<std::string> words = plain_words(name);
  if (any_in(words, patch_words)) return NamedKind::patch;
  if (any_in(words, muscle_folders)) return NamedKind::muscle;
  if (any_in(words, bone_folders)) return NamedKind::bone;
  return NamedKind::unknown;
}

template <class Known>
bool says_other(const NameMatch<Known>& match, const NameWords& words) {
  NameWords rest;
  rest.words = match.known ? match.rest : words.words;
  return names_something_else(rest);
}

/// By the names alone: the one that explains more of the words.
NamedKind kind_by_name(const NamedSurfaceFile& surface) {
  const bool bone = surface.bone.known != nullptr, muscle = surface.muscle.known != nullptr;
  if (!bone && !muscle) return says_other(surface.bone, surface.words) ? NamedKind::something_else : NamedKind::unknown;
  // Muscles are often named after bones, as "lumbar part of the diaphragm", bones hardly after muscles.
  const bool is_muscle = muscle && (!bone || surface.muscle.rest.size() <= surface.bone.rest.size());
  const bool other = is_muscle ? says_other(surface.muscle, surface.words) : says_other(surface.bone, surface.words);
  return other ? NamedKind::something_else : is_muscle ? NamedKind::muscle : NamedKind::bone;
}

NamedSurfaceFile named(const fs::path& file, const fs::path& folder) {
  NamedSurfaceFile surface;
  surface.file = file;
  surface.words = read_name(file.stem().string(), dictionary().words);
  NamedKind hint = NamedKind::unknown;
  for (const fs::path& part : file.parent_path().lexically_relative(folder)) {
    if (part == ".") continue;
    if (const NamedKind kind = kind_of_folder(part.string()); kind != NamedKind::unknown) hint = kind;
    const BodySide side = read_name(part.string(), dictionary().words).side;
    if (surface.words.side == BodySide::none) surface.words.side = side;
  }
  surface.bone = find_bone(surface.words);
  surface.muscle = find_muscle(surface.words);
  if (hint == NamedKind::unknown && any_in(plain_words(file.stem().string()), patch_words)) hint = NamedKind::patch;
  surface.kind = hint == NamedKind::unknown ? kind_by_name(surface) : hint;
  const bool unwanted = hint == NamedKind::bone     ? says_other(surface.bone, surface.words)
                        : hint == NamedKind::muscle ? says_other(surface.muscle, surface.words)
                                                    : false;
  if (unwanted) surface.kind = NamedKind::something_else;
  return surface;
}

/// Whether a drafted scene beside it wrote this table of landmarks.
bool is_of_a_scene(const fs::path& table) {
  const std::string stem = table.stem().string(), ending = "_landmarks";
  if (!stem.ends_with(ending)) return false;
  std::error_code ignored;
  return fs::exists(table.parent_path() / (stem.substr(0, stem.size() - ending.size()) + ".toml"), ignored);
}

}  // namespace

FolderFiles list_folder(const fs::path& folder) {
  std::error_code failed;
  fs::recursive_directory_iterator entry(folder, failed), end;
  if (failed) throw InputError({folder.string(), "", "cannot be read as a folder: " + failed.message(), ""});
  FolderFiles files;
  std::vector<fs::path> surfaces;
  for (; entry != end; entry.increment(failed)) {
    if (failed) throw InputError({folder.string(), "", "cannot be read: " + failed.message(), ""});
    const fs::path& path = entry->path();
    const bool hidden = path.filename().string().starts_with(".");
    if (entry->is_directory(failed)) {
      if (hidden || fs::exists(path / "run.json", failed)) entry.disable_recursion_pending();
    } else if (!hidden && surface_endings.contains(lower_case_extension(path))) {
      surfaces.push_back(path);
    } else if (!hidden && lower_case_extension(path) == ".csv" && !is_of_a_scene(path)) {
      files.tables.push_back(path);
    }
  }
  std::sort(surfaces.begin(), surfaces.end());
  std::sort(files.tables.begin(), files.tables.end());
  for (const fs::path& path : surfaces) files.surfaces.push_back(named(path, folder));
  return files;
}

FolderFiles list_files(const std::vector<fs::path>& files, const std::vector<fs::path>& bones) {
  FolderFiles all;
  const auto add = [&](const fs::path& file) -> NamedSurfaceFile& {
    const fs::path whole = fs::absolute(file).lexically_normal();
    all.surfaces.push_back(named(whole, whole.parent_path().parent_path()));
    all.surfaces.back().file = file;
    return all.surfaces.back();
  };
  for (const fs::path& file : files) add(file);
  for (const fs::path& file : bones) add(file).kind = NamedKind::bone;
  return all;
}

}  // namespace gracilis
