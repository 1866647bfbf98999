#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

/// Each answer begins with the `kind` of what was found.
namespace gracilis {

/// Of an OpenSim model: its bodies, joints, coordinates, muscles and other forces. Throws InputError.
nlohmann::ordered_json inspect_model(const std::filesystem::path& path);

}  // namespace gracilis
