#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

/// One function per kind of file; `kind` is their first entry.
namespace gracilis {

nlohmann::ordered_json inspect_surface(const std::filesystem::path& path);
nlohmann::ordered_json inspect_table(const std::filesystem::path& path);
nlohmann::ordered_json inspect_landmarks(const std::filesystem::path& path);
nlohmann::ordered_json inspect_model(const std::filesystem::path& path);
nlohmann::ordered_json inspect_scene(const std::filesystem::path& path);
nlohmann::ordered_json inspect_run(const std::filesystem::path& folder);

}  // namespace gracilis
