#pragma once

#include <gracilis/view/pictures/picture_layout.hpp>

#include <map>
#include <vector>

class vtkRenderWindow;
class vtkRenderer;

namespace gracilis {

/// Three lights fixed to the camera: key from the upper left, weaker fill from the right, rim from behind and above.
void add_camera_lights(vtkRenderer& renderer);

/// What is drawn at once: each panel with its caption, and what stands above and below them. The driver clears several
/// buffers of the window's size before it draws the first pixel, which takes longer than all that is drawn where a
/// window is as large as three panels. A single panel is drawn with everything around it: a film then never changes the
/// size.
std::vector<Rectangle> areas_to_draw(const PictureLayout& layout);

/// Fills the window, which is `scale` times the area's size, with one renderer per part of the picture in this area.
/// Returns those of the panels by their numbers; the window keeps them.
std::map<std::size_t, vtkRenderer*> add_renderers(const Picture& picture, const PictureLayout& layout,
                                                  const Rectangle& area, int scale, vtkRenderWindow& window);

/// Whether anything of a panel is seen through.
bool is_seen_through(const Panel& panel);

}  // namespace gracilis
