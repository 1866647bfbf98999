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
  if (vertices.cols() == 0) return vertices;
  const Vec3 middle = vertices.col(0);  // far from the origin single precision would not do
  Eigen::Matrix4Xf lanes(4, vertices.cols());
  lanes.topRows<3>() = (vertices.colwise() - middle).cast<float>();
  lanes.row(3).setZero();
  smooth_points(lanes, stars_, evening_rounds);
  Points evened = lanes.topRows<3>().cast<Real>().colwise() + middle;
  keep_within(farthest_, vertices, evened);
  return evened;
}

}  // namespace gracilis
