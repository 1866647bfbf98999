#pragma once

#include <gracilis/scene/contraction_settings.hpp>
#include <gracilis/scene/scene.hpp>
#include <gracilis/scene/settings.hpp>

#include <string_view>

namespace gracilis {

/// A named set of settings to start from. Those of the method count where a scene has that method.
struct Preset {
  std::string_view name;
  std::string_view meaning;  ///< one sentence
  MethodChoice method = {};
  DistanceFieldSettings distance_fields = {};
  ContractionSettings contraction = {};
};

}  // namespace gracilis
