#pragma once

#include <gracilis/scene/scene.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// The files that a scene names, as the scene reader takes them.
namespace gracilis {

/// Landmark clouds by name, each in the order of its rows. Throws InputError.
std::map<std::string, Points> read_scene_landmarks(const std::filesystem::path& path, Real unit);

/// A table of coordinates over time; what was wrong with it but could be survived goes into `warnings`. Throws InputError.
Motion read_scene_motion(const std::filesystem::path& path, std::vector<std::string>& warnings);

}  // namespace gracilis
