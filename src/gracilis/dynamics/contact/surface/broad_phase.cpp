#include <gracilis/dynamics/contact/surface/broad_phase.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/contact/surface/vertex_face_search.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

namespace {

/// A pair is searched again when something has drifted by this share of its reach since the search.
constexpr float trusted_share = 0.4f;
/// And after so many steps anyway: what is out of reach drifts unseen.
constexpr int trusted_steps = 3;

/// How far anything has moved at most, since the last look, against what it was near to then.
float largest_drift(const std::vector<VertexFaceCandidate>& near, const ContactSurface& surface, const Particles& probe,
                    const Particles& target, const Eigen::Vector3f& shift) {
  float largest2 = 0;
  for (const VertexFaceCandidate& candidate : near) {
    const Eigen::Vector3f then = point_on(surface, {candidate.face, candidate.barycentric}, target) + candidate.offset;
    largest2 = std::max(largest2, (probe.position(candidate.particle) + shift - then).squaredNorm());
  }
  return std::sqrt(largest2);
}

/// Searches one pair from nothing but where its particles are.
void search_pair(const ContactWorld& world, const std::vector<SearchedSurface>& searched, const SurfacePair& pair,
                 const ContactWorldState& state, PairCandidates& candidates) {
  const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
  if (pair.is_self()) {
    find_self(searched[a], self_rule(world, state, searched[a].particles, pair.first), pair.reach,
              candidates.near_second);
  } else {
    find_near(searched[a], pair.shift, searched[b], pair.reach, exit_of_first(world, pair), candidates.near_second);
    find_near(searched[b], -pair.shift, searched[a], pair.reach, exit_of_second(world, pair), candidates.near_first);
  }
  candidates.drift = 0, candidates.steps = 0;
}

}  // namespace

float largest_drift(const ContactWorld& world, const std::vector<const Particles*>& particles, const SurfacePair& pair,
                    const PairCandidates& candidates) {
  const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
  return std::max(largest_drift(candidates.near_second, world.surfaces[b], *particles[a], *particles[b], pair.shift),
                  largest_drift(candidates.near_first, world.surfaces[a], *particles[b], *particles[a], -pair.shift));
}

SelfRule self_rule(const ContactWorld& world, const ContactWorldState& state, const Particles& particles,
                   Index surface) {
  const auto at = static_cast<std::size_t>(surface);
  return {world.surfaces[at], world.rest[at], world.rest_normals[at],
          state.before[at],   particles,      world.neighborhood[at]};
}

void update_broad_phase(const ContactWorld& world, const std::vector<const Particles*>& particles,
                        ContactWorldState& state) {
  std::vector<float> drifts(world.pairs.size());
  parallel_for_each(drifts.size(), [&](std::size_t i) {
    drifts[i] = state.candidates[i].drift + largest_drift(world, particles, world.pairs[i], state.candidates[i]);
  });
  std::vector<Index> lost;
  for (std::size_t i = 0; i < world.pairs.size(); ++i) {
    PairCandidates& candidates = state.candidates[i];
    candidates.is_new = true;
    const float drift = drifts[i];
    const bool is_trusted = drift <= trusted_share * world.pairs[i].reach && ++candidates.steps < trusted_steps;
    if (!is_trusted) lost.push_back(static_cast<Index>(i));
  }
  std::vector<char> searched_for(particles.size(), 0);
  for (const Index i : lost) {
    const SurfacePair& pair = world.pairs[static_cast<std::size_t>(i)];
    for (const Index surface : {pair.first, pair.second}) searched_for[static_cast<std::size_t>(surface)] = 1;
  }
  parallel_for_each(particles.size(), [&](std::size_t s) {
    if (searched_for[s]) refit(world.surfaces[s], *particles[s], state.trees[s]);
  });
  std::vector<SearchedSurface> searched;
  for (std::size_t s = 0; s < particles.size(); ++s)
    searched.push_back({world.surfaces[s], *particles[s], state.trees[s]});
  parallel_for_each(lost.size(), [&](std::size_t i) {
    const auto number = static_cast<std::size_t>(lost[i]);
    search_pair(world, searched, world.pairs[number], state, state.candidates[number]);
  });
}

}  // namespace gracilis
