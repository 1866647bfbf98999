#pragma once

#include <gracilis/scene/motion.hpp>
#include <gracilis/scene/preparation.hpp>
#include <gracilis/scene/scene.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace gracilis {

/// What the command line says about a scene.
struct SceneOptions {
  std::filesystem::path data;  ///< --data; empty: as find_data_root says, from the scene file or else from its includes
  std::vector<std::string> set;   ///< --set key=value
  std::vector<std::string> only;  ///< --only: names of the muscles to keep; empty: all
  PrepareFunction prepare = {};   ///< for scenes with [prepare]; empty: only what is in the cache can be had
  std::function<void(const std::string&)> say = {};  ///< told what takes long; may be empty
};

/// A scene with what is worth telling about how it came to be.
struct LoadedScene {
  Scene scene;
  std::string preset;                         ///< the preset that its settings started from
  std::vector<std::filesystem::path> inputs;  ///< every file that was read, the scene file first
  std::vector<std::string> warnings;          ///< one line each
  std::vector<std::string> guessed;           ///< what the scene file says was guessed, beside attachments
  int max_frames = default_max_frames;        ///< that a run of it may have
};

/// Reads a scene file and all that it names: meshes, landmarks, motion. Paths in it are relative to the file that names
/// them or to the data root (data_root.hpp). docs: `gracilis print-config` writes a complete scene file with every key
/// explained. Throws ConfigurationError when the scene is wrong and InputError when a file is; both list all problems
/// of their kind.
LoadedScene read_scene(const std::filesystem::path& path, const SceneOptions& options = {});

/// What `gracilis prepare` works on.
struct SceneSurfaces {
  std::string name;  ///< of the scene
  std::vector<NamedSurface> muscles, bones;
  PrepareSettings settings;  ///< from [prepare], defaults without it
};

/// Reads the surfaces alone that a scene names: muscles as they are in their files, bones as read_scene has them.
/// Throws as read_scene does.
SceneSurfaces read_scene_surfaces(const std::filesystem::path& path, const SceneOptions& options = {});

}  // namespace gracilis
