#pragma once

#include <gracilis/view/pictures/palette.hpp>
#include <gracilis/view/window/shape_history.hpp>

#include <vector>

namespace gracilis {

/// Triangles with a color per point.
struct ColoredMesh {
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3i> faces;
  std::vector<Color> colors;
};

/// A shaft with a head from `root` to `root + along`, m. Nothing where `along` is zero.
void append_arrow(const Eigen::Vector3f& root, const Eigen::Vector3f& along, const Color& color, ColoredMesh& mesh);

/// An octahedron around `center`, m.
void append_dot(const Eigen::Vector3f& center, float radius, const Color& color, ColoredMesh& mesh);

}  // namespace gracilis
