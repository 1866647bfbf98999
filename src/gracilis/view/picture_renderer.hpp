#pragma once

#include <gracilis/view/picture_layout.hpp>

class vtkRenderWindow;

namespace gracilis {

/// Fills the window, which is `scale` times the layout's size, with one renderer per part of the picture.
void add_renderers(const Picture& picture, const PictureLayout& layout, int scale, vtkRenderWindow& window);

}  // namespace gracilis
