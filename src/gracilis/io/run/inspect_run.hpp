#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

/// Each answer begins with the `kind` of what was found.
namespace gracilis {

/// Of a scene file, with what it names: bones, joints and muscles. Throws as read_scene.
nlohmann::ordered_json inspect_scene(const std::filesystem::path& path);
/// Of a run folder: what its manifest tells, and the worst measures of all frames. Throws InputError.
nlohmann::ordered_json inspect_run(const std::filesystem::path& folder);

}  // namespace gracilis
