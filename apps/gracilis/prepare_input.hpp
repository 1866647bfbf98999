#pragma once

#include <gracilis/core/errors.hpp>
#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/scene/setting_table.hpp>
#include <gracilis/scene/settings.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// What 'gracilis prepare' is asked for, and the surfaces it is asked for.
namespace gracilis {

struct PrepareOptions {
  std::vector<std::filesystem::path> files, bones;
  std::filesystem::path out;
  std::string unit;                       ///< empty: not given
  std::vector<std::string> parts, apart;  ///< names; none: the whole files, all muscles
  bool merge = false, split = false, largest = false, keep_going = false;
  bool json = false;                             ///< print the report as JSON
  std::map<std::string, SettingValue> settings;  ///< those given on the command line
  SceneOptions scene;
};

/// "--edge-length" of edge_length.
std::string option_name(const Setting<PrepareSettings>& setting);

/// Whether the input is one scene instead of files of surfaces.
bool is_of_scene(const PrepareOptions& options);

/// Throws InputError where something is wrong, unless the others are to go on.
void stop_at(const std::vector<Problem>& problems, const PrepareOptions& options);

/// The surfaces, those of files pieced together as asked for. What is wrong with files that may be left out is added to
/// `problems`. Throws ConfigurationError where options have no use or name what is not there.
SceneSurfaces read_input(const PrepareOptions& options, std::vector<Problem>& problems);

}  // namespace gracilis
