#pragma once

#include <gracilis/io/scene/scene_reader.hpp>

#include <CLI/CLI.hpp>

#include <filesystem>

namespace gracilis {

/// Adds SCENE, --data, --set and --only to a command that reads a scene file.
void add_scene_options(CLI::App& command, std::filesystem::path& file, SceneOptions& options);

/// Adds --set and --only alone.
void add_setting_options(CLI::App& command, SceneOptions& options);

}  // namespace gracilis
