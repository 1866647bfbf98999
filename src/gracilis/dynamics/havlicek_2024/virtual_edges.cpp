#include <gracilis/dynamics/havlicek_2024/virtual_edges.hpp>

#include <gracilis/core/parallel.hpp>

#include <algorithm>

namespace gracilis {

namespace {

/// Shorter vectors (m) have no direction.
constexpr float no_way = 1e-9f;

/// Moves `end` to its neighbor nearest to `target`, if that is nearer than `distance2`. True when it moved.
bool step_nearer(Index& end, const Eigen::Vector3f& target, const VertexStars& stars, const Particles& particles,
                 float& distance2) {
  const auto at = static_cast<std::size_t>(end);
  bool moved = false;
  for (Index i = stars.offsets[at]; i < stars.offsets[at + 1]; ++i) {
    const Index neighbor = stars.neighbors[static_cast<std::size_t>(i)];
    const float there = (particles.position(neighbor) - target).squaredNorm();
    if (!(there < distance2)) continue;
    distance2 = there;
    end = neighbor;
    moved = true;
  }
  return moved;
}

Eigen::Vector3f unit(const Eigen::Vector3f& v) {
  const float length = v.norm();
  return length > no_way ? Eigen::Vector3f(v / length) : Eigen::Vector3f(Eigen::Vector3f::Zero());
}

Index project_pair(const VirtualEdgeWorld& world, const VirtualEdgePair& pair, const std::vector<Particles>& previous,
                   const std::vector<Particles*>& particles, PairEdges& edges) {
  const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
  const VirtualEdgeSettings& settings = world.settings;
  Index pushes = 0;
  for (PairEdges::Edge& edge : edges.edges) {
    const EdgeWalk walk =
        walk_virtual_edge(settings.reset ? edge.seed : edge.now, world.stars[a], *particles[a], world.stars[b],
                          *particles[b], pair.shift, edge.distance, settings.walk_steps);
    edge.now = walk.end;
    if (!walk.near) continue;
    pushes += part_ends(edge.now, settings.resolution, edge.distance, pair.shift, previous[a], previous[b],
                        *particles[a], *particles[b]);
  }
  return pushes;
}

}  // namespace

EdgeWalk walk_virtual_edge(VirtualEdge edge, const VertexStars& first_stars, const Particles& first,
                           const VertexStars& second_stars, const Particles& second, const Eigen::Vector3f& shift,
                           float distance, int most_steps) {
  EdgeWalk walk;
  walk.end = edge;
  Index &a = walk.end.a, &b = walk.end.b;
  float distance2 = (first.position(a) + shift - second.position(b)).squaredNorm();
  while (walk.steps < most_steps) {
    ++walk.steps;
    const bool zig = step_nearer(a, second.position(b) - shift, first_stars, first, distance2);
    const bool zag = step_nearer(b, first.position(a) + shift, second_stars, second, distance2);
    walk.near = distance2 < distance * distance;
    if (walk.near || !(zig || zag)) break;
  }
  return walk;
}

Eigen::Vector3f parting_direction(EdgeResolution resolution, const Eigen::Vector3f& now, const Eigen::Vector3f& before,
                                  float distance) {
  const Eigen::Vector3f along = unit(now), back = before - now;
  if (along.isZero()) return unit(before);
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();
  if (resolution == EdgeResolution::unit_sum) direction = unit(along + unit(back));
  if (resolution == EdgeResolution::vector_sum) direction = unit(distance * along + back);
  return direction.isZero() ? along : direction;
}

bool part_ends(VirtualEdge edge, EdgeResolution resolution, float distance, const Eigen::Vector3f& shift,
               const Particles& first_before, const Particles& second_before, Particles& first, Particles& second) {
  const float first_weight = first.inverse_mass(edge.a), second_weight = second.inverse_mass(edge.b);
  if (!(first_weight + second_weight > 0)) return false;
  const Eigen::Vector3f now = first.position(edge.a) + shift - second.position(edge.b);
  const Eigen::Vector3f before = first_before.position(edge.a) + shift - second_before.position(edge.b);
  const Eigen::Vector3f direction = parting_direction(resolution, now, before, distance);
  if (direction.isZero()) return false;
  const Eigen::Vector3f change = (distance * direction - now) / (first_weight + second_weight);
  first.position(edge.a) += first_weight * change;
  second.position(edge.b) -= second_weight * change;
  return true;
}

void remember_positions(const std::vector<const Particles*>& particles, VirtualEdgeState& state) {
  state.previous.resize(particles.size());
  for (std::size_t s = 0; s < particles.size(); ++s) state.previous[s] = *particles[s];
}

void adapt_distances(const VirtualEdgeWorld& world, const std::vector<const Particles*>& particles,
                     VirtualEdgeState& state) {
  const VirtualEdgeSettings& settings = world.settings;
  for (std::size_t i = 0; i < world.pairs.size(); ++i) {
    const VirtualEdgePair& pair = world.pairs[i];
    const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
    const auto length = [&](VirtualEdge edge, const Particles& first, const Particles& second) {
      return (first.position(edge.a) + pair.shift - second.position(edge.b)).norm();
    };
    for (PairEdges::Edge& edge : state.pairs[i].edges) {
      edge.distance = settings.distance;
      if (!settings.adaptive) continue;
      const float nearer =
          length(edge.now, state.previous[a], state.previous[b]) - length(edge.now, *particles[a], *particles[b]);
      edge.distance = std::max(edge.distance, std::min(nearer, settings.reach));
    }
  }
}

Index project_virtual_edges(const VirtualEdgeWorld& world, const std::vector<Particles*>& particles,
                            VirtualEdgeState& state) {
  for (const std::vector<Index>& round : world.rounds)
    parallel_for_each(round.size(), [&](std::size_t i) {
      const auto number = static_cast<std::size_t>(round[i]);
      PairEdges& edges = state.pairs[number];
      edges.pushes = project_pair(world, world.pairs[number], state.previous, particles, edges);
    });
  Index pushes = 0;
  for (const PairEdges& edges : state.pairs) pushes += edges.pushes;
  return pushes;
}

}  // namespace gracilis
