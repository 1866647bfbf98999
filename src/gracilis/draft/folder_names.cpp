#include <gracilis/draft/folder_names.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/io/input_file.hpp>

#include <algorithm>
#include <fstream>
#include <set>

namespace gracilis {
namespace {

namespace fs = std::filesystem;

const std::set<std::string> surface_endings = {".ply", ".stl", ".obj", ".vtk", ".vtp", ".glb"};
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

/// Whether a name that could be both is a muscle's: by what explains more of the words, then by the spelling (a
/// trapezium is a carpal bone, no misspelled trapezius). Muscles are often named after bones, as "lumbar part of the
/// diaphragm", bones hardly after muscles.
bool is_rather_muscle(const NamedSurfaceFile& surface) {
  const std::size_t of_muscle = surface.muscle.rest.size(), of_bone = surface.bone.rest.size();
  if (of_muscle != of_bone) return of_muscle < of_bone;
  return surface.muscle.certainty >= surface.bone.certainty;
}

/// By the names alone.
NamedKind kind_by_name(const NamedSurfaceFile& surface) {
  const bool bone = surface.bone.known != nullptr, muscle = surface.muscle.known != nullptr;
  if (!bone && !muscle) return says_other(surface.bone, surface.words) ? NamedKind::something_else : NamedKind::unknown;
  const bool is_muscle = muscle && (!bone || is_rather_muscle(surface));
  const bool other = is_muscle ? says_other(surface.muscle, surface.words) : says_other(surface.bone, surface.words);
  return other ? NamedKind::something_else : is_muscle ? NamedKind::muscle : NamedKind::bone;
}

/// What a name in these folders (of a part: its file's stem is the last of them) says.
NamedSurfaceFile named(const std::string& name, const fs::path& folders) {
  NamedSurfaceFile surface;
  surface.words = read_name(name, dictionary().words);
  NamedKind hint = NamedKind::unknown;
  for (const fs::path& folder : folders) {
    if (folder == ".") continue;
    if (const NamedKind kind = kind_of_folder(folder.string()); kind != NamedKind::unknown) hint = kind;
    const BodySide side = read_name(folder.string(), dictionary().words).side;
    if (surface.words.side == BodySide::none) surface.words.side = side;
  }
  surface.bone = find_bone(surface.words);
  surface.muscle = find_muscle(surface.words);
  if (hint == NamedKind::unknown && any_in(plain_words(name), patch_words)) hint = NamedKind::patch;
  surface.kind = hint == NamedKind::unknown ? kind_by_name(surface) : hint;
  const bool unwanted = hint == NamedKind::bone     ? says_other(surface.bone, surface.words)
                        : hint == NamedKind::muscle ? says_other(surface.muscle, surface.words)
                                                    : false;
  if (unwanted) surface.kind = NamedKind::something_else;
  return surface;
}

const std::string table_ending = "_landmarks", mended_ending = "_mended";

/// Whether a drafted scene beside it wrote this table of landmarks, or this folder of mended surfaces: a person may
/// give files such names, too.
bool is_of_a_scene(const fs::path& path, const std::string& ending) {
  const std::string stem = path.stem().string();
  if (!stem.ends_with(ending)) return false;
  std::ifstream scene(path.parent_path() / (stem.substr(0, stem.size() - ending.size()) + ".toml"));
  std::string first;
  return std::getline(scene, first) && first.starts_with(drafted_scene_mark);
}

/// Adds the file's surfaces, whose names are looked at with the folders that they lie in. A .glb with one mesh that is
/// called nothing in particular is called after its file.
void add_surfaces(const fs::path& file, const fs::path& folders, FolderFiles& files) {
  std::vector<std::string> parts;
  try {
    parts = files.meshes->parts(file);
  } catch (const InputError& error) {
    files.unreadable.push_back(error.what());
    return;
  }
  const std::string stem = file.stem().string();
  std::vector<NamedSurfaceFile> surfaces;
  for (const std::string& part : parts) {
    surfaces.push_back(named(part, folders / stem));
    surfaces.back().part = part;
  }
  const auto is_known = [](const NamedSurfaceFile& each) { return each.bone.known || each.muscle.known; };
  if (surfaces.empty() || (surfaces.size() == 1 && !is_known(surfaces.front()))) surfaces = {named(stem, folders)};
  for (NamedSurfaceFile& surface : surfaces) {
    surface.file = file;
    files.surfaces.push_back(std::move(surface));
  }
}

}  // namespace

fs::path mended_folder(const fs::path& scene) { return scene.parent_path() / (scene.stem().string() + mended_ending); }

FolderFiles list_folder(const fs::path& folder) {
  std::error_code failed;
  fs::recursive_directory_iterator entry(folder, fs::directory_options::follow_directory_symlink, failed), end;
  if (failed) throw InputError({folder.string(), "", "cannot be read as a folder: " + failed.message(), ""});
  FolderFiles files;
  std::set<fs::path> entered = {fs::canonical(folder, failed)};  // links may lead to each other
  std::vector<fs::path> surfaces;
  for (; entry != end; entry.increment(failed)) {
    if (failed) throw InputError({folder.string(), "", "cannot be read: " + failed.message(), ""});
    const fs::path& path = entry->path();
    const bool hidden = path.filename().string().starts_with(".");
    if (entry->is_directory(failed)) {
      if (hidden || fs::exists(path / "run.json", failed) || is_of_a_scene(path, mended_ending) ||
          !entered.insert(fs::canonical(path, failed)).second)
        entry.disable_recursion_pending();
    } else if (!hidden && surface_endings.contains(lower_case_extension(path))) {
      surfaces.push_back(path);
    } else if (!hidden && lower_case_extension(path) == ".csv" && !is_of_a_scene(path, table_ending)) {
      files.tables.push_back(path);
    }
  }
  std::sort(surfaces.begin(), surfaces.end());
  std::sort(files.tables.begin(), files.tables.end());
  for (const fs::path& path : surfaces) add_surfaces(path, path.parent_path().lexically_relative(folder), files);
  return files;
}

FolderFiles list_files(const std::vector<fs::path>& files, const std::vector<fs::path>& bones) {
  FolderFiles all;
  const auto add = [&](const fs::path& file) {
    add_surfaces(file, fs::absolute(file).lexically_normal().parent_path().filename(), all);
  };
  for (const fs::path& file : files) add(file);
  const std::size_t first_bone = all.surfaces.size();
  for (const fs::path& file : bones) add(file);
  for (std::size_t s = first_bone; s < all.surfaces.size(); ++s) all.surfaces[s].kind = NamedKind::bone;
  return all;
}

}  // namespace gracilis
