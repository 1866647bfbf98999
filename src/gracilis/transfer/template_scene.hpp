#pragma once

#include <gracilis/io/scene/scene_reader.hpp>

#include <toml++/toml.h>

#include <filesystem>
#include <string>

namespace gracilis {

/// A template: what it says, and the tables that say it.
struct TemplateScene {
  std::string name;  ///< as given
  LoadedScene loaded;
  toml::table tables;                     ///< with all that it includes
  std::filesystem::path file, data_root;  ///< empty: it comes from no file
};

/// A scene file, or "demo" or "demo-elbow" for the built-in ones. Throws as read_scene does.
TemplateScene read_template(const std::string& name, const SceneOptions& options);

/// The same of a scene in memory, as far as built-in scenes go: without lines, sheets, given fibers and activations.
TemplateScene template_of(const Scene& scene);

}  // namespace gracilis
