#include <gracilis/view/pictures/drawn_together.hpp>

#include <map>
#include <tuple>

namespace gracilis {

static PaintedSurface joined(const std::vector<const PaintedSurface*>& surfaces) {
  Index vertices = 0, faces = 0;
  for (const PaintedSurface* each : surfaces) vertices += each->mesh.vertex_count(), faces += each->mesh.face_count();
  PaintedSurface all;
  all.opacity = surfaces.front()->opacity;
  all.solid = surfaces.front()->solid;
  all.mesh = {Points(3, vertices), Eigen::Matrix3Xi(3, faces)};
  all.colors.resize(3, vertices);
  vertices = faces = 0;
  for (const PaintedSurface* each : surfaces) {
    const Index count = each->mesh.vertex_count();
    all.mesh.vertices.middleCols(vertices, count) = each->mesh.vertices;
    all.mesh.faces.middleCols(faces, each->mesh.face_count()) = each->mesh.faces.array() + vertices;
    if (each->colors.cols() == count)
      all.colors.middleCols(vertices, count) = each->colors;
    else
      all.colors.middleCols(vertices, count).colwise() = each->color;
    all.stripes.insert(all.stripes.end(), each->stripes.begin(), each->stripes.end());
    vertices += count, faces += each->mesh.face_count();
  }
  return all;
}

std::vector<PaintedSurface> drawn_together(const std::vector<PaintedSurface>& surfaces) {
  std::map<std::tuple<Real, bool, bool>, std::vector<const PaintedSurface*>> alike;
  for (const PaintedSurface& surface : surfaces)
    alike[{surface.opacity, surface.solid, surface.stripes.empty()}].push_back(&surface);
  std::vector<PaintedSurface> result;
  for (const auto& [what, together] : alike) result.push_back(joined(together));
  return result;
}

}  // namespace gracilis
