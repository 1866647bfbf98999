#pragma once

#include <gracilis/core/types.hpp>

#include <string_view>
#include <vector>

namespace gracilis {

/// A muscle by all its names: Latin ones as anatomists write them, and OpenSim's short ones.
struct NamedMuscle {
  int shade = 0;  ///< 0 dark ... 5 light; of no other muscle that lies beside this one, nor of its group
  std::vector<std::string_view> names;
};

/// Muscles that lie and work together: one hue, and a shade for each.
struct MuscleGroup {
  Real hue = 0;         ///< degrees
  Real saturation = 0;  ///< of the HSL color
  std::vector<NamedMuscle> muscles;
};

/// Groups that are far from each other may share a hue. Shades were chosen by trial, so that muscles which touch differ
/// most for any kind of color vision.
const std::vector<MuscleGroup>& muscle_groups();

}  // namespace gracilis
