#pragma once

#include <gracilis/view/pictures/picture_layout.hpp>

class vtkRenderWindow;
class vtkRenderer;

namespace gracilis {

/// Three lights fixed to the camera: key from the upper left, weaker fill from the right, rim from behind and above.
void add_camera_lights(vtkRenderer& renderer);

/// Fills the window, which is `scale` times the layout's size, with one renderer per part of the picture. Returns those
/// of the panels; the window keeps them.
std::vector<vtkRenderer*> add_renderers(const Picture& picture, const PictureLayout& layout, int scale,
                                        vtkRenderWindow& window);

/// Whether anything of a panel is seen through.
bool is_seen_through(const Panel& panel);

}  // namespace gracilis
