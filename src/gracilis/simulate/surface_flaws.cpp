#include <gracilis/simulate/surface_flaws.hpp>

#include <gracilis/geometry/opposite_vertices.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace gracilis {

SurfaceFlaws::SurfaceFlaws(const TriangleMesh& rest)
    : SurfaceFlaws(rest, build_topology(rest.faces, rest.vertex_count()).edges) {}

SurfaceFlaws::SurfaceFlaws(const TriangleMesh& rest, std::vector<MeshEdge> edges)
    : edges_(std::move(edges)), opposite_(opposite_vertices(rest)) {
  const Points& x = rest.vertices;
  const auto count = static_cast<std::size_t>(x.cols());
  std::vector<Real> sums(count);
  std::vector<Index> degrees(count);
  for (const MeshEdge& edge : edges_) {
    edge_lengths_.push_back((x.col(edge.a) - x.col(edge.b)).norm());
    for (const Index v : {edge.a, edge.b})
      sums[static_cast<std::size_t>(v)] += edge_lengths_.back(), ++degrees[static_cast<std::size_t>(v)];
  }
  mean_edge_ = std::accumulate(edge_lengths_.begin(), edge_lengths_.end(), Real{0}) /
               static_cast<Real>(std::max<std::size_t>(edges_.size(), 1));
  begin_.assign(count + 1, 0);
  std::partial_sum(degrees.begin(), degrees.end(), begin_.begin() + 1);
  neighbors_.resize(static_cast<std::size_t>(begin_.back()));
  std::vector<Index> next(begin_.begin(), begin_.end() - 1);
  for (const MeshEdge& edge : edges_) {
    neighbors_[static_cast<std::size_t>(next[static_cast<std::size_t>(edge.a)]++)] = edge.b;
    neighbors_[static_cast<std::size_t>(next[static_cast<std::size_t>(edge.b)]++)] = edge.a;
  }
  for (Index v = 0; v < x.cols(); ++v) {
    const auto i = static_cast<std::size_t>(v);
    apart_.push_back(from_neighbors(v, x).norm());
    reach_.push_back(std::max(degrees[i] > 0 ? sums[i] / static_cast<Real>(degrees[i]) : 0, mean_edge_ / 2));
    thickness_.push_back(opposite_[i] < 0 ? 0 : (x.col(v) - x.col(opposite_[i])).norm());
  }
}

Vec3 SurfaceFlaws::from_neighbors(Index vertex, const Points& points) const {
  const auto v = static_cast<std::size_t>(vertex);
  const Index begin = begin_[v], end = begin_[v + 1];
  if (begin == end) return Vec3::Zero();
  Vec3 sum = Vec3::Zero();
  for (Index i = begin; i < end; ++i) sum += points.col(neighbors_[static_cast<std::size_t>(i)]);
  return points.col(vertex) - sum / static_cast<Real>(end - begin);
}

Real SurfaceFlaws::spike_at(Index vertex, const Points& points) const {
  const auto v = static_cast<std::size_t>(vertex);
  return std::max(from_neighbors(vertex, points).norm() - apart_[v], Real{0}) / reach_[v];
}

Real SurfaceFlaws::thickness_at(Index vertex, const Points& points) const {
  const auto v = static_cast<std::size_t>(vertex);
  if (opposite_[v] < 0) return 1;
  return ((points.col(vertex) - points.col(opposite_[v])).norm() + mean_edge_) / (thickness_[v] + mean_edge_);
}

Real SurfaceFlaws::edge_ratio(Real length, Real rest_length) const {
  const Real least = mean_edge_ / 2;
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

std::vector<Real> SurfaceFlaws::shares_of_gates(const Points& points, const QualityGates& gates) const {
  const auto share = [](Real value, Real bar) { return (value - 1) / (bar - 1); };
  std::vector<Real> shares(static_cast<std::size_t>(points.cols()));
  for (Index v = 0; v < points.cols(); ++v) {
    const Real thickness = thickness_at(v, points);
    shares[static_cast<std::size_t>(v)] = std::max(
        {spike_at(v, points) / gates.spike, share(thickness, gates.thickening), share(1 / thickness, gates.thinning)});
  }
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const Real length = (points.col(edges_[e].a) - points.col(edges_[e].b)).norm();
    const Real of_edge = share(edge_ratio(length, edge_lengths_[e]), gates.near_edge_ratio);
    for (const Index v : {edges_[e].a, edges_[e].b})
      shares[static_cast<std::size_t>(v)] = std::max(shares[static_cast<std::size_t>(v)], of_edge);
  }
  return shares;
}

}  // namespace gracilis
