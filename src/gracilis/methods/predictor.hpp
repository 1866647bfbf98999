#pragma once

#include <gracilis/scene/setting_table.hpp>

#include <array>
#include <string_view>

namespace gracilis {

/// Where free vertices are when a solver begins.
enum class Predictor {
  none,     ///< where they were, so that they follow through constraints alone
  carried,  ///< carried by what carries the surface
  arap      ///< carried, then brought nearer to an as-rigid-as-possible surface (methods/arap_predictor.hpp)
};
/// The names of the choices, in their order.
constexpr std::array<std::string_view, 3> choices_of(Predictor) { return {"none", "carried", "arap"}; }

/// Where a solver begins, for settings with a member `predictor`.
template <class Settings>
Setting<Settings> predictor_row() {
  return {"predictor",
          &Settings::predictor,
          "",
          0,
          0,
          "Where free vertices are when the solver begins: 'none' leaves them where they were, 'carried' carries them "
          "with the bones, 'arap' also brings them nearer to an as-rigid-as-possible surface."};
}

}  // namespace gracilis
