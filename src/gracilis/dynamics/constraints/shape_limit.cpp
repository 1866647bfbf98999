#include <gracilis/dynamics/constraints/shape_limit.hpp>

#include <gracilis/geometry/opposite_vertices.hpp>
#include <gracilis/geometry/topology.hpp>

#include <algorithm>
#include <numeric>

namespace gracilis {

namespace {

Eigen::Vector3f mean_of_neighbors(const ShapeLimitSet& set, Index particle, const Particles& particles) {
  const auto p = static_cast<std::size_t>(particle);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (Index i = set.offsets[p]; i < set.offsets[p + 1]; ++i)
    sum += particles.position(set.neighbors[static_cast<std::size_t>(i)]);
  return sum / static_cast<float>(set.offsets[p + 1] - set.offsets[p]);
}

bool has_neighbors(const ShapeLimitSet& set, std::size_t p) { return set.offsets[p + 1] > set.offsets[p]; }

/// The farthest that a particle may be from the mean of its neighbors, and from the one that it faces, m.
float farthest_apart(const ShapeLimitSet& set, float spike, std::size_t p) {
  return set.apart[p] + spike * set.reach[p];
}
float thickest(const ShapeLimitSet& set, float thickness, std::size_t p) {
  return thickness * (set.thickness[p] + set.mean_edge) - set.mean_edge;
}

/// C(x) = apart - |x - mean|, with the gradients -n for the particle and n / count for each neighbor.
bool push_back_spike(const ShapeLimitSet& set, float spike, Index particle, Particles& particles) {
  const auto p = static_cast<std::size_t>(particle);
  if (!has_neighbors(set, p)) return false;
  const Eigen::Vector3f out = particles.position(particle) - mean_of_neighbors(set, particle, particles);
  const float length = out.norm(), beyond = length - farthest_apart(set, spike, p);
  if (!(beyond > 0)) return false;
  const float share = 1 / static_cast<float>(set.offsets[p + 1] - set.offsets[p]);
  float weight = particles.inverse_mass(particle);
  for (Index i = set.offsets[p]; i < set.offsets[p + 1]; ++i)
    weight += share * share * particles.inverse_mass(set.neighbors[static_cast<std::size_t>(i)]);
  if (!(weight > 0)) return false;
  const Eigen::Vector3f push = (beyond / (weight * length)) * out;
  particles.position(particle) -= particles.inverse_mass(particle) * push;
  for (Index i = set.offsets[p]; i < set.offsets[p + 1]; ++i) {
    const Index neighbor = set.neighbors[static_cast<std::size_t>(i)];
    particles.position(neighbor) += share * particles.inverse_mass(neighbor) * push;
  }
  return true;
}

bool press_together(const ShapeLimitSet& set, float thickness, Index particle, Particles& particles) {
  const auto p = static_cast<std::size_t>(particle);
  const Index opposite = set.opposite[p];
  if (opposite < 0) return false;
  const Eigen::Vector3f across = particles.position(particle) - particles.position(opposite);
  const float length = across.norm(), beyond = length - thickest(set, thickness, p);
  const float weight = particles.inverse_mass(particle) + particles.inverse_mass(opposite);
  if (!(beyond > 0) || !(weight > 0)) return false;
  const Eigen::Vector3f push = (beyond / (weight * length)) * across;
  particles.position(particle) -= particles.inverse_mass(particle) * push;
  particles.position(opposite) += particles.inverse_mass(opposite) * push;
  return true;
}

}  // namespace

ShapeLimitSet build_shape_limits(const TriangleMesh& rest) {
  const Points& x = rest.vertices;
  const auto count = static_cast<std::size_t>(x.cols());
  const std::vector<MeshEdge> edges = build_topology(rest.faces, rest.vertex_count()).edges;
  ShapeLimitSet set;
  set.offsets.assign(count + 1, 0);
  for (const MeshEdge& edge : edges)
    for (const Index v : {edge.a, edge.b}) ++set.offsets[static_cast<std::size_t>(v) + 1];
  std::partial_sum(set.offsets.begin(), set.offsets.end(), set.offsets.begin());
  set.neighbors.resize(2 * edges.size());
  std::vector<Index> next(set.offsets.begin(), set.offsets.end() - 1);
  std::vector<Real> lengths(count);
  Real total = 0;
  for (const MeshEdge& edge : edges) {
    const Real length = (x.col(edge.a) - x.col(edge.b)).norm();
    total += length;
    for (const auto& [v, other] : {std::pair(edge.a, edge.b), std::pair(edge.b, edge.a)}) {
      set.neighbors[static_cast<std::size_t>(next[static_cast<std::size_t>(v)]++)] = other;
      lengths[static_cast<std::size_t>(v)] += length;
    }
  }
  const Real mean_edge = total / static_cast<Real>(std::max<std::size_t>(edges.size(), 1));
  set.mean_edge = static_cast<float>(mean_edge);
  set.opposite = opposite_vertices(rest);
  for (std::size_t v = 0; v < count; ++v) {
    Vec3 sum = Vec3::Zero();
    for (Index i = set.offsets[v]; i < set.offsets[v + 1]; ++i)
      sum += x.col(set.neighbors[static_cast<std::size_t>(i)]);
    const auto degree = static_cast<Real>(std::max(set.offsets[v + 1] - set.offsets[v], Index{1}));
    const Vec3 at = x.col(static_cast<Index>(v));
    set.apart.push_back(has_neighbors(set, v) ? static_cast<float>((at - sum / degree).norm()) : 0);
    set.reach.push_back(static_cast<float>(std::max(lengths[v] / degree, mean_edge / 2)));
    set.thickness.push_back(set.opposite[v] < 0 ? 0 : static_cast<float>((at - x.col(set.opposite[v])).norm()));
  }
  return set;
}

std::vector<Index> near_shape_limits(const ShapeLimitSet& set, const ShapeLimits& limits, float share,
                                     const Particles& particles) {
  std::vector<Index> near;
  for (Index particle = 0; particle < static_cast<Index>(set.apart.size()); ++particle) {
    const auto p = static_cast<std::size_t>(particle);
    const auto spikes = [&] {
      return limits.spike > 0 && has_neighbors(set, p) &&
             (particles.position(particle) - mean_of_neighbors(set, particle, particles)).norm() >
                 farthest_apart(set, share * limits.spike, p);
    };
    const auto swells = [&] {
      return limits.thickness > 0 && set.opposite[p] >= 0 &&
             (particles.position(particle) - particles.position(set.opposite[p])).norm() >
                 thickest(set, 1 + share * (limits.thickness - 1), p);
    };
    if (swells() || spikes()) near.push_back(particle);
  }
  return near;
}

Index project_shape_limits(const ShapeLimitSet& set, const ShapeLimits& limits, const std::vector<Index>& listed,
                           Particles& particles) {
  Index beyond = 0;
  for (const Index particle : listed) {
    if (limits.thickness > 0) beyond += press_together(set, limits.thickness, particle, particles);
    if (limits.spike > 0) beyond += push_back_spike(set, limits.spike, particle, particles);
  }
  return beyond;
}

}  // namespace gracilis
