#pragma once

#include <gracilis/scene/contraction_settings.hpp>
#include <gracilis/scene/settings.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace gracilis {

/// A named set of settings to start from.
struct Preset {
  std::string_view name;
  std::string_view meaning;  ///< one sentence
  XpbdSettings xpbd;
  DistanceFieldSettings distance_fields;
  ContactSettings contact;
  ContractionSettings contraction = {};
};

/// `physical`, the default: real masses and units. `thesis-2024`: the published setting of the method, with everything
/// that this project added switched off; it is there to compare with and does break. `fast`: coarser copies of the
/// muscles are simulated, and the surfaces follow them.
const std::vector<Preset>& presets();

/// The preset with this name, or null.
const Preset* find_preset(std::string_view name);

}  // namespace gracilis
