#include <gracilis/view/window/window_state.hpp>

namespace gracilis {

/// What is apart stays pale, so that contact is what one sees. Most of a muscle is farther apart than the scale
/// reaches.
static ColorScale depth_scale() {
  ColorScale scale = color_scale(ColorBy::activation);
  scale.name = "contact-depth";
  scale.title = "contact depth, mm";
  scale.low = -0.002;
  scale.high = 0.002;
  scale.ticks = {"≥ 2 apart", "touching", "2 deep"};
  return scale;
}

const ColorScale& window_scale(WindowColor color) {
  static const ColorScale depth = depth_scale(), none;
  switch (color) {
    case WindowColor::activation:
      return color_scale(ColorBy::activation);
    case WindowColor::fiber_strain:
      return color_scale(ColorBy::fiber_strain);
    case WindowColor::edge_stretch:
      return color_scale(ColorBy::edge_stretch);
    case WindowColor::volume:
      return color_scale(ColorBy::volume);
    case WindowColor::stress:
      return color_scale(ColorBy::stress);
    case WindowColor::tension:
      return color_scale(ColorBy::tension);
    case WindowColor::contact_depth:
      return depth;
    case WindowColor::natural:
    case WindowColor::muscle:
    case WindowColor::tissue:
      break;
  }
  return none;
}

const std::vector<TissueColor>& tissue_colors() {
  static const std::vector<TissueColor> colors = {{"belly", Color(0.66, 0.20, 0.18)},
                                                  {"tendon", Color(0.95, 0.93, 0.86)},
                                                  {"origin", Color(0.00, 0.35, 0.62)},
                                                  {"insertion", Color(0.90, 0.62, 0.00)}};
  return colors;
}

}  // namespace gracilis
