#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>

namespace gracilis {

/// What is in a file or run folder, for programs: always `file` and `kind`, then what that kind has to say. Understands
/// surfaces (.ply .stl .obj .vtk .vtp), tables (.mot .sto .csv), landmarks (.csv), models (.osim), scenes (.toml) and
/// run folders. Throws InputError when it cannot be read or is of no kind we know.
nlohmann::ordered_json inspect_file(const std::filesystem::path& path);

/// The same for people: one fact per line.
std::string describe_file(const std::filesystem::path& path);

/// Renders any such description; numbers to 6 digits.
std::string to_text(const nlohmann::ordered_json& description);

}  // namespace gracilis
