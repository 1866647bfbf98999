#include <gracilis/io/scene/data_root.hpp>

#include <gracilis/core/errors.hpp>

#include <cstdlib>

namespace gracilis {

namespace fs = std::filesystem;

static fs::path existing_folder(const fs::path& folder, const char* source) {
  std::error_code ignored;
  if (fs::is_directory(folder, ignored)) return folder;
  throw ConfigurationError(
      {folder.string(), "", "the data folder does not exist", std::string("it was given by ") + source});
}

fs::path find_data_root(const fs::path& scene_file, const fs::path& given) {
  if (!given.empty()) return existing_folder(given, "--data");
  if (const char* variable = std::getenv("GRACILIS_DATA"); variable && *variable) {
    return existing_folder(variable, "the environment variable GRACILIS_DATA");
  }
  std::error_code ignored;
  for (fs::path folder = fs::absolute(scene_file).lexically_normal().parent_path();; folder = folder.parent_path()) {
    if (fs::is_directory(folder / "shared" / "data", ignored)) return folder / "shared" / "data";
    if (folder == folder.parent_path()) return {};
  }
}

}  // namespace gracilis
