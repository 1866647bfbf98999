#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

/// Each answer begins with the `kind` of what was found.
namespace gracilis {

nlohmann::ordered_json inspect_scene(const std::filesystem::path& path);
nlohmann::ordered_json inspect_run(const std::filesystem::path& folder);

}  // namespace gracilis
