#pragma once

#include <gracilis/io/scene/scene_reader.hpp>
#include <gracilis/scene/presets.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// Starts a scene that comes from no file from a preset: its method, and all settings, those of single muscles, too.
void change_to_preset(const Preset& preset, LoadedScene& loaded);

/// Changes such a scene as `--set` and `--only` change one from a file; a key for all muscles here replaces what single
/// muscles have. A preset brings its method unless `method` names another; what the scene was made with for a method
/// goes with it. Throws ConfigurationError with every problem found: unknown keys, values out of range, muscles that
/// are not there, keys of tables that only files have (motion, prepare), and what asks for more memory than there is.
void change_scene(LoadedScene& loaded, const std::vector<std::string>& set, const std::vector<std::string>& only);

}  // namespace gracilis
