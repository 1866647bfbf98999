#include <gracilis/view/pictures/evened_surface.hpp>

#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/smoothing.hpp>

#include <utility>

namespace gracilis {

static constexpr int evening_rounds = 8;

EvenedSurface::EvenedSurface(const TriangleMesh& rest) {
  MeshTopology topology = build_topology(rest.faces, rest.vertex_count());
  farthest_ = mean_edge_length(topology.edges, rest.vertices) / 2;
  stars_ = std::move(topology.stars);
}

Points EvenedSurface::of(const Points& vertices) const {
  Points evened = vertices;
  smooth_points(evened, stars_, evening_rounds);
  keep_within(farthest_, vertices, evened);
  return evened;
}

}  // namespace gracilis
