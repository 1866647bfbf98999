#include <gracilis/view/window/glyphs.hpp>

#include <algorithm>

namespace gracilis {

static int append_point(const Eigen::Vector3f& point, const Color& color, ColoredMesh& mesh) {
  mesh.points.push_back(point);
  mesh.colors.push_back(color);
  return static_cast<int>(mesh.points.size()) - 1;
}

void append_arrow(const Eigen::Vector3f& root, const Eigen::Vector3f& along, const Color& color, ColoredMesh& mesh) {
  static constexpr int sides = 4;
  const float length = along.norm();
  if (!(length > 0)) return;
  const Eigen::Vector3f direction = along / length;
  const Eigen::Vector3f right = direction.unitOrthogonal(), up = direction.cross(right);
  const float head = std::min(length / 2, 0.004f), head_radius = 0.35f * head, shaft_radius = 0.3f * head_radius;
  const auto append_ring = [&](float at, float radius) {
    const int first = static_cast<int>(mesh.points.size());
    for (int i = 0; i < sides; ++i) {
      const float angle = static_cast<float>(2 * pi) * static_cast<float>(i) / sides;
      append_point(root + at * direction + radius * (std::cos(angle) * right + std::sin(angle) * up), color, mesh);
    }
    return first;
  };
  const int base = append_ring(0, shaft_radius), neck = append_ring(length - head, shaft_radius);
  const int brim = append_ring(length - head, head_radius), tip = append_point(root + along, color, mesh);
  for (int i = 0; i < sides; ++i) {
    const int next = (i + 1) % sides;
    mesh.faces.emplace_back(base + i, base + next, neck + next);
    mesh.faces.emplace_back(base + i, neck + next, neck + i);
    mesh.faces.emplace_back(brim + i, brim + next, tip);
  }
  mesh.faces.emplace_back(brim, brim + 2, brim + 1);
  mesh.faces.emplace_back(brim, brim + 3, brim + 2);
}

void append_dot(const Eigen::Vector3f& center, float radius, const Color& color, ColoredMesh& mesh) {
  const int first = static_cast<int>(mesh.points.size());
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-radius, radius}) append_point(center + side * Eigen::Vector3f::Unit(axis), color, mesh);
  for (int x = 0; x < 2; ++x)
    for (int y = 2; y < 4; ++y)
      for (int z = 4; z < 6; ++z) {
        const bool turned = (x + y + z) % 2 == 0;
        mesh.faces.emplace_back(first + x, first + (turned ? z : y), first + (turned ? y : z));
      }
}

}  // namespace gracilis
