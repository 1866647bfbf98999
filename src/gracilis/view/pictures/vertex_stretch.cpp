#include <gracilis/view/pictures/vertex_stretch.hpp>

namespace gracilis {

static std::vector<Real> lengths_around(const std::vector<MeshEdge>& edges, const Points& points) {
  std::vector<Real> sums(static_cast<std::size_t>(points.cols()));
  for (const MeshEdge& edge : edges) {
    const Real length = (points.col(edge.a) - points.col(edge.b)).norm();
    sums[static_cast<std::size_t>(edge.a)] += length;
    sums[static_cast<std::size_t>(edge.b)] += length;
  }
  return sums;
}

VertexStretch::VertexStretch(const TriangleMesh& rest)
    : edges_(build_topology(rest.faces, rest.vertex_count()).edges), rest_(lengths_around(edges_, rest.vertices)) {}

std::vector<Real> VertexStretch::of(const Points& points) const {
  std::vector<Real> ratios = lengths_around(edges_, points);
  for (std::size_t v = 0; v < ratios.size(); ++v) ratios[v] = rest_[v] > 0 ? ratios[v] / rest_[v] : 1;
  return ratios;
}

}  // namespace gracilis
