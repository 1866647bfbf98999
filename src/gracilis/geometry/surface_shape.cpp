#include <gracilis/geometry/surface_shape.hpp>

#include <gracilis/geometry/measures.hpp>
#include <gracilis/geometry/opposite_vertices.hpp>

#include <algorithm>

namespace gracilis {

Vec3 from_neighbors(const VertexStars& stars, Index vertex, const Points& points) {
  const auto v = static_cast<std::size_t>(vertex);
  const Index begin = stars.offsets[v], end = stars.offsets[v + 1];
  if (begin == end) return Vec3::Zero();
  Vec3 sum = Vec3::Zero();
  for (Index i = begin; i < end; ++i) sum += points.col(stars.neighbors[static_cast<std::size_t>(i)]);
  return points.col(vertex) - sum / static_cast<Real>(end - begin);
}

SurfaceShape shape_of(const TriangleMesh& surface, const MeshTopology& topology) {
  const Points& x = surface.vertices;
  SurfaceShape shape;
  shape.stars = topology.stars;
  shape.opposite = opposite_vertices(surface);
  shape.mean_edge = mean_edge_length(topology.edges, x);
  for (Index vertex = 0; vertex < x.cols(); ++vertex) {
    const auto v = static_cast<std::size_t>(vertex);
    const Index begin = shape.stars.offsets[v], end = shape.stars.offsets[v + 1];
    Real sum = 0;
    for (Index i = begin; i < end; ++i)
      sum += (x.col(vertex) - x.col(shape.stars.neighbors[static_cast<std::size_t>(i)])).norm();
    const Real around = begin == end ? 0 : sum / static_cast<Real>(end - begin);
    const Index opposite = shape.opposite[v];
    shape.apart.push_back(from_neighbors(shape.stars, vertex, x).norm());
    shape.reach.push_back(std::max(around, shape.mean_edge / 2));
    shape.thickness.push_back(opposite < 0 ? 0 : (x.col(vertex) - x.col(opposite)).norm());
  }
  return shape;
}

}  // namespace gracilis
