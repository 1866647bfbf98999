#include <gracilis/dynamics/contact/surface/surface_contact.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/contact/surface/pressing_candidates.hpp>
#include <gracilis/dynamics/leverage.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <optional>
#include <span>

namespace gracilis {

namespace {

/// Where a contact stands and what it moves: up to two particles of one side against up to three of the other.
struct Contact {
  std::array<Index, 2> probe{-1, -1};
  std::array<float, 2> probe_weight{};
  std::array<Index, 3> target{-1, -1, -1};
  std::array<float, 3> target_weight{};
  Eigen::Vector3f normal;
  float distance = 0, gap = 0;
  bool bound = false;  ///< both touched at rest: cohesion holds them
};

/// One side of a pair, seen from the other.
struct Sides {
  const ContactSurface& target_surface;
  const Eigen::Matrix3Xf& target_normals;
  const std::vector<char>&probe_touches, &target_touches;
  Eigen::Vector3f shift;  ///< from the probe's coordinates to the target's
  bool is_self = false;
};

Sides toward_second(const ContactWorld& world, const SurfacePair& pair, const ContactWorldState& state) {
  const auto second = static_cast<std::size_t>(pair.second);
  return {world.surfaces[second], state.normals[second], pair.first_touches, pair.second_touches, pair.shift,
          pair.is_self()};
}

Sides toward_first(const ContactWorld& world, const SurfacePair& pair, const ContactWorldState& state) {
  const auto first = static_cast<std::size_t>(pair.first);
  return {world.surfaces[first], state.normals[first], pair.second_touches,
          pair.first_touches,    -pair.shift,          pair.is_self()};
}

Contact contact_of(const VertexFaceCandidate& candidate, const Sides& sides, const Particles& probe,
                   const Particles& target) {
  const auto p = static_cast<std::size_t>(candidate.particle);
  const PointGap gap = point_gap(probe.position(candidate.particle) + sides.shift, sides.target_surface, candidate.face,
                                 target, sides.target_normals);
  Contact contact;
  contact.probe[0] = candidate.particle;
  contact.probe_weight[0] = 1;
  contact.bound = sides.probe_touches[p];
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const Index particle = sides.target_surface.faces(static_cast<Index>(corner), candidate.face);
    const auto at = static_cast<std::size_t>(particle);
    contact.target[corner] = particle;
    contact.target_weight[corner] = gap.barycentric[static_cast<Index>(corner)];
    contact.bound = contact.bound && sides.target_touches[at];
  }
  contact.normal = candidate.side * gap.normal;
  contact.distance = candidate.side * gap.distance;
  contact.gap = candidate.most_gap;
  return contact;
}

/// Takes back a share of the tangential motion since the step began, as much as the push allows (Coulomb).
Eigen::Vector3f friction_of(const Contact& contact, float friction, float push, const Eigen::Vector3f& moved) {
  const Eigen::Vector3f tangential = moved - contact.normal.dot(moved) * contact.normal;
  const float length = tangential.norm();
  return length > 0 ? Eigen::Vector3f(-tangential * std::min(1.0f, friction * push / length))
                    : Eigen::Vector3f(Eigen::Vector3f::Zero());
}

/// What contacts move.
struct Moved {
  const Particles& start;  ///< where the step began
  Particles& particles;    ///< where they are
  bool moves = true;       ///< whether it can be moved

  float inverse_mass(Index particle) const { return moves ? particles.inverse_mass(particle) : 0; }

  /// Moves a particle, but not away from where the step began once it is `most` from there.
  void push(Index particle, const Eigen::Vector3f& by, float most) {
    const Eigen::Vector3f from = particles.position(particle) - start.position(particle), to = from + by;
    const float length = to.norm();
    if (length > most) {
      const float kept = std::max(most, from.norm());
      if (length > kept) {
        particles.position(particle) = start.position(particle) + kept / length * to;
        return;
      }
    }
    particles.position(particle) += by;
  }
};

/// Moves both sides until the gap is kept. True when it had to.
bool project(const Contact& contact, const SurfaceContactSettings& settings, Moved& probe, Moved& target) {
  float wanted = contact.gap - contact.distance;
  const bool parted = contact.bound && settings.cohesion > 0 && contact.distance > settings.cohesion;
  if (parted) wanted = settings.cohesion - contact.distance;
  if (!(wanted > 0) && !parted) return false;
  float weight = 0, largest = 0;
  Eigen::Vector3f moved = Eigen::Vector3f::Zero();
  const auto add = [&](Index particle, float share, const Moved& side, float sign) {
    if (particle < 0) return;
    const float inverse_mass = side.inverse_mass(particle);
    weight += share * share * inverse_mass, largest = std::max(largest, share * inverse_mass);
    if (settings.friction > 0)
      moved += sign * share * (side.particles.position(particle) - side.start.position(particle));
  };
  for (std::size_t i = 0; i < 2; ++i) add(contact.probe[i], contact.probe_weight[i], probe, 1);
  for (std::size_t i = 0; i < 3; ++i) add(contact.target[i], contact.target_weight[i], target, -1);
  weight = limit_leverage(weight, largest);
  if (!(weight > 0)) return false;
  Eigen::Vector3f push = wanted * contact.normal;
  if (settings.friction > 0 && !parted) push += friction_of(contact, settings.friction, wanted, moved);
  push /= weight;
  for (std::size_t i = 0; i < 2; ++i) {
    const Index p = contact.probe[i];
    if (p >= 0) probe.push(p, probe.inverse_mass(p) * contact.probe_weight[i] * push, settings.most_motion);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Index p = contact.target[i];
    if (p >= 0) target.push(p, -target.inverse_mass(p) * contact.target_weight[i] * push, settings.most_motion);
  }
  return true;
}

/// Calls act(candidate) for those that press. A block is looked at when its turn comes, after the pushes of those
/// before.
template <class Candidate, class Look, class Act>
Index for_each_pressing(const std::vector<Candidate>& candidates, const Look& look, const Act& act) {
  Index count = 0;
  for (std::size_t begin = 0; begin < candidates.size(); begin += candidates_per_block) {
    const auto block = std::span(candidates).subspan(begin, std::min(candidates_per_block, candidates.size() - begin));
    for (PressingBits bits = look(block); bits != 0; bits &= bits - 1)
      count += act(block[static_cast<std::size_t>(std::countr_zero(bits))]);
  }
  return count;
}

Index project_points(const std::vector<VertexFaceCandidate>& candidates, const Sides& sides,
                     const SurfaceContactSettings& settings, Moved probe, Moved target) {
  const auto look = [&](std::span<const VertexFaceCandidate> block) {
    // Cohesion also draws what has parted.
    if (settings.cohesion > 0) return ~PressingBits{0} >> (32 - block.size());
    return pressing_points(block, sides.target_surface, sides.shift, probe.particles, target.particles);
  };
  return for_each_pressing(candidates, look, [&](const VertexFaceCandidate& candidate) {
    return project(contact_of(candidate, sides, probe.particles, target.particles), settings, probe, target);
  });
}

/// Where two edges cross; nothing where they do not.
std::optional<Contact> contact_of(const ContactWorld& world, const SurfacePair& pair,
                                  const EdgeEdgeCandidate& candidate, const Particles& probe, const Particles& target) {
  const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
  const auto& first = world.surfaces[a].edges[static_cast<std::size_t>(candidate.first)].ends;
  const auto& second = world.surfaces[b].edges[static_cast<std::size_t>(candidate.second)].ends;
  const EdgeGap gap = edge_gap(probe.position(first[0]) + pair.shift, probe.position(first[1]) + pair.shift,
                               target.position(second[0]), target.position(second[1]), candidate.outward);
  if (!gap.crossing) return {};
  const auto between = [](const std::vector<float>& gaps, const std::array<Index, 2>& ends, float t) {
    return (1 - t) * gaps[static_cast<std::size_t>(ends[0])] + t * gaps[static_cast<std::size_t>(ends[1])];
  };
  Contact contact;
  contact.probe = first;
  contact.probe_weight = {1 - gap.s, gap.s};
  contact.target = {second[0], second[1], -1};
  contact.target_weight = {1 - gap.t, gap.t, 0};
  contact.normal = gap.normal;
  contact.distance = gap.distance;
  contact.gap =
      std::min({between(pair.first_gap, first, gap.s), between(pair.second_gap, second, gap.t), candidate.most_gap});
  return contact;
}

Index project_edges(const ContactWorld& world, const SurfacePair& pair,
                    const std::vector<EdgeEdgeCandidate>& candidates, Moved probe, Moved target) {
  const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
  const auto look = [&](std::span<const EdgeEdgeCandidate> block) {
    return pressing_edges(block, world.surfaces[a], world.surfaces[b], pair.shift, probe.particles, target.particles);
  };
  return for_each_pressing(candidates, look, [&](const EdgeEdgeCandidate& candidate) {
    const std::optional<Contact> contact = contact_of(world, pair, candidate, probe.particles, target.particles);
    return contact && project(*contact, world.settings, probe, target);
  });
}

}  // namespace

Index project_candidates(const ContactWorld& world, const ContactWorldState& state,
                         const std::vector<const Particles*>& start, const std::vector<Particles*>& particles,
                         const Movers& movers) {
  std::atomic<Index> count = 0;
  const auto project_pair = [&](Index number) {
    const SurfacePair& pair = world.pairs[static_cast<std::size_t>(number)];
    const PairCandidates& candidates = state.candidates[static_cast<std::size_t>(number)];
    const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
    const Moved first{*start[a], *particles[a], movers.move(a)}, second{*start[b], *particles[b], movers.move(b)};
    Index pushed = project_edges(world, pair, candidates.edges, first, second);
    pushed += project_points(candidates.on_second, toward_second(world, pair, state), world.settings, first, second);
    pushed += project_points(candidates.on_first, toward_first(world, pair, state), world.settings, second, first);
    count += pushed;
  };
  std::vector<Index> touching;
  for (const std::vector<Index>& round : world.rounds) {
    touching.clear();
    for (const Index number : round) {
      const auto at = static_cast<std::size_t>(number);
      if (any_moves(world.pairs[at], movers) && !state.candidates[at].none_listed()) touching.push_back(number);
    }
    parallel_for_each(touching.size(), [&](std::size_t i) { project_pair(touching[i]); });
  }
  return count;
}

}  // namespace gracilis
