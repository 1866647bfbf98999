#pragma once

#include <gracilis/view/pictures/palette.hpp>

#include <string>
#include <utility>
#include <vector>

namespace gracilis {

/// What pictures of runs tell by color: nothing but what muscles look like, or which muscle it is, or a value.
enum class ColorBy { natural, muscle, activation, fiber_strain, edge_stretch, bone_gap, volume, stress, tension };

/// Values to colors, with what stands beside the bar. Colors run from the lowest value to the highest.
struct ColorScale {
  std::string name;   ///< as on the command line, e.g. edge-stretch
  std::string title;  ///< with the unit
  std::vector<Color> colors;
  Real low = 0, high = 1;
  std::vector<std::string> ticks;
};

/// One for each ColorBy, in its order. Scales with a middle go from blue over a light tone to red (after Brewer's
/// RdBu), the others from light to dark: color-blind readers see their order, and so does gray print, which tells of
/// the former how far from the middle values are, not to which side. Ratios are shown by their binary logarithm, so
/// that half and double are equally far from 1; stress (Pa) and tension (N) by the decimal one.
const std::vector<ColorScale>& color_scales();

/// The one of color_scales for this.
const ColorScale& color_scale(ColorBy by);

/// What stands beside the bar where values from the first to the second are shown: an end that they go beyond says so.
std::vector<std::string> ticks_for(const ColorScale& scale, std::pair<Real, Real> seen);

/// Blended between the scale's colors; values beyond its ends get the ends'.
Color color_at(const ColorScale& scale, Real value);

}  // namespace gracilis
