#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

/// Each answer begins with the `kind` of what was found.
namespace gracilis {

/// Of a file that read_mesh takes: its counts, size, likely unit and what is wrong with it. Throws InputError.
nlohmann::ordered_json inspect_surface(const std::filesystem::path& path);
/// So many slices of a surface across its longest axis (surface_slices), with their outlines.
nlohmann::ordered_json inspect_slices(const std::filesystem::path& path, int count);
/// Of a file that read_table takes: its columns with their ranges, rows and times (s). Throws InputError.
nlohmann::ordered_json inspect_table(const std::filesystem::path& path);
/// Of a file that read_landmarks takes: its clouds with their centers (m). Throws InputError.
nlohmann::ordered_json inspect_landmarks(const std::filesystem::path& path);

}  // namespace gracilis
