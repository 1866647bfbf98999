#pragma once

#include <gracilis/scene/preparation.hpp>

#include <nlohmann/json.hpp>

#include <string>

namespace gracilis {

/// What preparation moved and how far, for people: some lines per muscle and one per pair that met. Lengths in mm,
/// volumes in cm³.
std::string to_text(const PreparationReport& report);

/// The same for programs; units are in the keys.
nlohmann::ordered_json to_json(const PreparationReport& report);

}  // namespace gracilis
