#pragma once

#include <gracilis/core/types.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// Red, green and blue in 0 ... 1 (sRGB).
using Color = Vec3;

/// Ivory.
Color bone_color();

/// Pale, of muscles whose fibers carry the colors: neither bone nor a color of a scale.
Color flesh_color();

/// The color of the i-th of several things that are told apart, by the palette; repeats after its length. Muscles have
/// colors by their names (muscle_colors.hpp).
Color series_color(Index i);

}  // namespace gracilis
