#pragma once

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gracilis {

/// Tables of a scene file that hold settings alone, beside those of its elements.
inline constexpr std::array<std::string_view, 8> setting_sections = {
    "settings", "contact", "surfaces", "distance_field", "sequence", "fibers", "contraction", "prepare"};

/// Whether it is one of setting_sections.
inline bool is_setting_section(std::string_view name) {
  return std::find(setting_sections.begin(), setting_sections.end(), name) != setting_sections.end();
}

/// A scene file with everything it includes and what the command line sets, merged into one table. Every node knows the
/// file, line and column it came from; what came from `--set a=b` names "--set a=b" as its file.
struct SceneLayers {
  toml::table table;
  std::vector<std::filesystem::path> files;  ///< all that were read, the scene file first
  std::vector<std::string> notes;            ///< what the user should know about the merge
};

/// Reads `path` and the files in its key `include`, which lie relative to it; a later include wins over an earlier one,
/// the file over all it includes, and `set` ("key=value") over everything. Tables merge key by key and lists of tables
/// with names element by element; anything else, and [motion], is replaced as a whole. A layer that names a preset sets
/// aside the method and the settings of all layers below it, since they were chosen for another one. Throws InputError
/// for files that cannot be read, ConfigurationError for what is not TOML, for includes in a circle, and for settings
/// of muscles that the scene does not have.
SceneLayers load_scene_layers(const std::filesystem::path& path, const std::vector<std::string>& set);

/// The command line's settings alone, for a scene with these muscles that comes from no file.
SceneLayers command_line_layers(const std::vector<std::string>& set, const std::vector<std::string>& muscles);

}  // namespace gracilis
