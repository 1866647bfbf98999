#include <gracilis/io/scene/files.hpp>

#include <algorithm>
#include <system_error>

namespace gracilis::sections {

namespace fs = std::filesystem;

Real unit_of(TomlReader& table, const std::string& key) {
  const std::string unit = table.text(key).value_or("m");
  if (unit == "m") return 1;
  if (unit == "cm") return 0.01;
  if (unit == "mm") return 0.001;
  table.add_problem(key, "'" + key + "' must be \"m\", \"cm\" or \"mm\"");
  return 1;
}

NamedFile named_file(TomlReader& table, const std::string& path) {
  return {path, unit_of(table, "unit"), table.place()};
}

NamedFile file_at(TomlReader& table, const std::string& key) {
  return {table.text(key).value_or(""), 1, table.place()};
}

static fs::path beside_scene(const NamedFile& file) { return fs::path(file.place.file).parent_path() / file.path; }

fs::path located(const SceneInProgress& progress, const NamedFile& file) {
  const fs::path& root = progress.data_root;
  std::error_code ignored;
  if (const fs::path beside = beside_scene(file); fs::exists(beside, ignored)) return beside.lexically_normal();
  if (fs::path(file.path).is_relative() && !root.empty() && fs::exists(root / file.path, ignored))
    return (root / file.path).lexically_normal();
  return {};
}

/// Where the file was looked for.
static std::string places_of(const NamedFile& file, const fs::path& root) {
  std::string places = "looked for '" + beside_scene(file).lexically_normal().string() + "'";
  if (!fs::path(file.path).is_relative()) return places;
  if (root.empty()) return places + "; there is no data root: give --data DIR or set GRACILIS_DATA";
  return places + " and '" + (root / file.path).lexically_normal().string() + "'";
}

void read_file(SceneInProgress& progress, const NamedFile& file, const std::function<void(const fs::path&)>& read) {
  const fs::path path = located(progress, file);
  if (path.empty()) {
    progress.add_problem(file.place, "the file '" + file.path + "' does not exist",
                         places_of(file, progress.data_root));
    return;
  }
  std::vector<fs::path>& inputs = progress.loaded.inputs;
  if (std::find(inputs.begin(), inputs.end(), path) == inputs.end()) inputs.push_back(path);
  try {
    read(path);
  } catch (const InputError& error) {
    progress.problems.insert(progress.problems.end(), error.problems().begin(), error.problems().end());
  }
}

}  // namespace gracilis::sections
