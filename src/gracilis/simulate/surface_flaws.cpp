#include <gracilis/simulate/surface_flaws.hpp>

#include <algorithm>

namespace gracilis {

SurfaceFlaws::SurfaceFlaws(const TriangleMesh& rest)
    : SurfaceFlaws(rest, build_topology(rest.faces, rest.vertex_count())) {}

SurfaceFlaws::SurfaceFlaws(const TriangleMesh& rest, const MeshTopology& topology)
    : edges_(topology.edges), shape_(shape_of(rest, topology)) {
  for (const MeshEdge& edge : edges_)
    edge_lengths_.push_back((rest.vertices.col(edge.a) - rest.vertices.col(edge.b)).norm());
}

Real SurfaceFlaws::spike_at(Index vertex, const Points& points) const {
  const auto v = static_cast<std::size_t>(vertex);
  const Real apart = from_neighbors(shape_.stars, vertex, points).norm();
  return std::max(apart - shape_.apart[v], Real{0}) / shape_.reach[v];
}

Real SurfaceFlaws::thickness_at(Index vertex, const Points& points) const {
  const auto v = static_cast<std::size_t>(vertex);
  const Index opposite = shape_.opposite[v];
  if (opposite < 0) return 1;
  return ((points.col(vertex) - points.col(opposite)).norm() + shape_.mean_edge) /
         (shape_.thickness[v] + shape_.mean_edge);
}

Real SurfaceFlaws::edge_ratio(Real length, Real rest_length) const {
  const Real least = shape_.mean_edge / 2;
  return std::max(length, least) / std::max(rest_length, least);
}

SurfaceFlaws::Worst SurfaceFlaws::worst(const Points& points) const {
  Worst worst;
  for (Index v = 0; v < points.cols(); ++v) {
    worst.spike = std::max(worst.spike, spike_at(v, points));
    const Real thickness = thickness_at(v, points);
    worst.thickening = std::max(worst.thickening, thickness);
    worst.thinning = std::max(worst.thinning, 1 / thickness);
  }
  return worst;
}

std::vector<Real> SurfaceFlaws::shares_of_gates(const Points& points, const std::vector<char>& near,
                                                const QualityGates& gates) const {
  const auto share = [](Real value, Real bar) { return (value - 1) / (bar - 1); };
  std::vector<Real> shares(static_cast<std::size_t>(points.cols()));
  for (Index v = 0; v < points.cols(); ++v) {
    const Real thickness = thickness_at(v, points);
    shares[static_cast<std::size_t>(v)] = std::max(
        {spike_at(v, points) / gates.spike, share(thickness, gates.thickening), share(1 / thickness, gates.thinning)});
  }
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto a = static_cast<std::size_t>(edges_[e].a), b = static_cast<std::size_t>(edges_[e].b);
    const Real length = (points.col(edges_[e].a) - points.col(edges_[e].b)).norm(), rest = edge_lengths_[e];
    const Real of_edge = near[a] || near[b] ? share(edge_ratio(length, rest), gates.near_edge_ratio)
                         : rest > 0         ? share(length / rest, gates.free_edge_ratio)
                                            : 0;
    for (const std::size_t v : {a, b}) shares[v] = std::max(shares[v], of_edge);
  }
  return shares;
}

}  // namespace gracilis
