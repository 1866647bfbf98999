#pragma once

#include <gracilis/view/pictures/picture.hpp>

#include <vector>

namespace gracilis {

/// Surfaces that differ in nothing but their shape and colors, as one with a color per vertex: a hundred surfaces take
/// OpenGL and VTK several times as long as one of as many triangles. Names are left out.
std::vector<PaintedSurface> drawn_together(const std::vector<PaintedSurface>& surfaces);

}  // namespace gracilis
