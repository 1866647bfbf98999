#include <gracilis/view/pictures/evened_surface.hpp>

#include <gracilis/geometry/smoothing.hpp>

#include <algorithm>
#include <utility>

namespace gracilis {

static constexpr int evening_rounds = 8;

EvenedSurface::EvenedSurface(const TriangleMesh& rest) {
  MeshTopology topology = build_topology(rest.faces, rest.vertex_count());
  for (const MeshEdge& edge : topology.edges)
    farthest_ += (rest.vertices.col(edge.a) - rest.vertices.col(edge.b)).norm();
  farthest_ *= 0.5 / static_cast<Real>(std::max<std::size_t>(topology.edges.size(), 1));
  stars_ = std::move(topology.stars);
}

Points EvenedSurface::of(const Points& vertices) const {
  Points evened = vertices;
  smooth_points(evened, stars_, evening_rounds);
  for (Index v = 0; v < evened.cols(); ++v) {
    const Vec3 move = evened.col(v) - vertices.col(v);
    if (const Real way = move.norm(); way > farthest_) evened.col(v) = vertices.col(v) + farthest_ / way * move;
  }
  return evened;
}

}  // namespace gracilis
