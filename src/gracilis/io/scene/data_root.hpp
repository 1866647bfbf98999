#pragma once

#include <filesystem>

namespace gracilis {

/// The folder in which files named by a scene are looked for when they do not lie beside the scene. In this order:
/// `given` (from --data); the environment variable GRACILIS_DATA; the first folder shared/data found next to
/// `scene_file` or above it, which finds ../shared/data beside a checkout that holds the scene. Empty when there is
/// none of them. Throws ConfigurationError when the folder from --data or GRACILIS_DATA does not exist.
std::filesystem::path find_data_root(const std::filesystem::path& scene_file, const std::filesystem::path& given);

}  // namespace gracilis
