#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

/// Each answer begins with the `kind` of what was found.
namespace gracilis {

nlohmann::ordered_json inspect_surface(const std::filesystem::path& path);
/// So many slices of a surface across its longest axis (surface_slices), with their outlines.
nlohmann::ordered_json inspect_slices(const std::filesystem::path& path, int count);
nlohmann::ordered_json inspect_table(const std::filesystem::path& path);
nlohmann::ordered_json inspect_landmarks(const std::filesystem::path& path);

}  // namespace gracilis
