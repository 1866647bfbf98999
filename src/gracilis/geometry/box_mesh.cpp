#include <gracilis/geometry/box_mesh.hpp>

#include <map>
#include <vector>

namespace gracilis {

TriangleMesh box_mesh(const Vec3& low, const Vec3& high, const std::array<int, 3>& cells) {
  std::map<std::array<int, 3>, Index> numbers;
  std::vector<Vec3> vertices;
  const auto vertex = [&](const std::array<int, 3>& node) {
    const auto [found, fresh] = numbers.try_emplace(node, static_cast<Index>(vertices.size()));
    if (fresh) {
      Vec3 p;
      for (int k = 0; k < 3; ++k) {
        const auto at = static_cast<std::size_t>(k);
        p[k] = low[k] + (high[k] - low[k]) * node[at] / cells[at];
      }
      vertices.push_back(p);
    }
    return found->second;
  };
  std::vector<std::array<Index, 3>> faces;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const int side : {0, cells[axis]})
      for (int i = 0; i < cells[u]; ++i)
        for (int j = 0; j < cells[v]; ++j) {
          // Around the cell, counter-clockwise seen from outside.
          std::array<Index, 4> corners;
          for (std::size_t c = 0; c < 4; ++c) {
            std::array<int, 3> node{};
            node[axis] = side;
            const bool turned = side == 0;
            node[turned ? v : u] = (turned ? j : i) + (c == 1 || c == 2);
            node[turned ? u : v] = (turned ? i : j) + (c >= 2);
            corners[c] = vertex(node);
          }
          const std::size_t first = (i + j) % 2 == 0 ? 0 : 1;
          for (std::size_t half : {first, first + 2})
            faces.push_back({corners[half % 4], corners[(half + 1) % 4], corners[(half + 2) % 4]});
        }
  }
  TriangleMesh mesh;
  mesh.vertices.resize(3, static_cast<Index>(vertices.size()));
  mesh.faces.resize(3, static_cast<Index>(faces.size()));
  for (std::size_t i = 0; i < vertices.size(); ++i) mesh.vertices.col(static_cast<Index>(i)) = vertices[i];
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (int k = 0; k < 3; ++k) mesh.faces(k, static_cast<Index>(i)) = faces[i][static_cast<std::size_t>(k)];
  return mesh;
}

}  // namespace gracilis
