#pragma once

#include <gracilis/view/pictures/picture.hpp>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace gracilis {

/// A part of the picture, in pixels from its lower left corner.
struct Rectangle {
  int x = 0, y = 0, width = 0, height = 0;
};

/// What a panel's camera (parallel projection) looks at, and along which axes.
struct CameraView {
  Vec3 center = Vec3::Zero();  ///< m, in the middle of the panel
  Vec3 looking, up, right;     ///< orthonormal
};

/// How a legend's entries stand, row by row from the left.
struct LegendGrid {
  int columns = 1, font = 0, row_height = 0;  ///< pixels
};

/// Where everything of a picture goes.
struct PictureLayout {
  int width = 0, height = 0;  ///< of the whole picture, pixels
  Real text = 1;              ///< how many times as large letters are as in a picture of 1200 pixels, from 1
  Rectangle title, legend;    ///< height 0: none
  Rectangle color_bar;        ///< beside the legend, or below it where that had no room; height 0: none
  Rectangle scale_bar;  ///< where captions have no room beside it; height 0: it stands in the first panel's caption
  LegendGrid legend_grid;
  std::vector<Rectangle> panels;    ///< one per panel, the caption's strip excluded
  std::vector<Rectangle> captions;  ///< one per panel, below it
  std::vector<CameraView> cameras;  ///< one per panel
  Real half_height = 0;             ///< m, from the middle of a panel to its upper edge; the same for all panels
  std::vector<std::pair<std::string, Color>> legend_entries;  ///< distinct named surfaces, in order of first appearance
};

/// Panels that look the same way get the same camera, so that what moves between them can be compared, unless they have
/// their own.
/// Throws ConfigurationError when there is no panel, nothing to see, a size below one pixel or a camera without
/// direction.
PictureLayout lay_out(const Picture& picture);

/// A length of letters or what stands among them, pixels of a picture that is up to 1200 wide, in this one.
inline int text_pixels(const PictureLayout& layout, Real pixels) {
  return static_cast<int>(std::lround(layout.text * pixels));
}

}  // namespace gracilis
