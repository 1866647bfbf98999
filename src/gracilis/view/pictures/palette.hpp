#pragma once

#include <gracilis/core/types.hpp>

#include <string>
#include <vector>

namespace gracilis {

/// Red, green and blue in 0 ... 1 (sRGB).
using Color = Vec3;

/// Which colors muscles get. `flesh` looks like muscle; its neighbors in the list differ in lightness as well as in
/// hue, so that they stay apart in gray print and for color-blind readers. `okabe_ito` is the palette of Okabe and Ito
/// (2008), made for color-blind readers, and looks like a diagram.
enum class Palette { flesh, okabe_ito };

/// Ivory.
Color bone_color();

/// The color of the i-th muscle; repeats after the palette's length.
Color muscle_color(Index i, Palette palette = Palette::flesh);

}  // namespace gracilis
