#pragma once

#include <gracilis/view/pictures/picture_layout.hpp>

#include <cstddef>

class vtkRenderer;

namespace gracilis {

/// What is written on pictures, each into the renderer of its part of the window, which is `scale` times as large as
/// that part.

/// In the middle, smaller where it would not find room.
void draw_title(const Picture& picture, const PictureLayout& layout, int scale, vtkRenderer& renderer);

/// A line of a round length, at most a fifth of the panel, in the lower left corner.
void draw_scale_bar(const PictureLayout& layout, int scale, vtkRenderer& renderer);

/// A panel's, with the scale bar where it stands beside it. All captions of a picture are written in one size; where
/// they would become too small they are written in several lines.
void draw_caption(const Picture& picture, const PictureLayout& layout, std::size_t panel, int scale,
                  vtkRenderer& renderer);

/// Swatch and name of every entry, in cells of equal width.
void draw_legend(const PictureLayout& layout, int scale, vtkRenderer& renderer);

/// A strip of colors with its title to the left and its values below.
void draw_color_bar(const ColorBar& bar, const PictureLayout& layout, int scale, vtkRenderer& renderer);

}  // namespace gracilis
