#include <gracilis/dynamics/contact/surface/surface_search.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/contact/surface/touch_search.hpp>

#include <algorithm>
#include <cmath>

namespace gracilis {

namespace {

/// A pair is searched again when something has drifted by this share of its reach since the search.
constexpr float trusted_share = 0.4f;
/// And after so many steps anyway: what is out of reach drifts unseen.
constexpr int trusted_steps = 3;

/// How far anything has moved at most, since the last look, against what it was near to then.
float largest_drift(const std::vector<PointTouch>& near, const ContactSurface& surface, const Particles& probe,
                    const Particles& target, const Eigen::Vector3f& shift) {
  float largest2 = 0;
  for (const PointTouch& touch : near) {
    const Eigen::Vector3f then = point_on(surface, {touch.face, touch.barycentric}, target) + touch.offset;
    largest2 = std::max(largest2, (probe.position(touch.particle) + shift - then).squaredNorm());
  }
  return std::sqrt(largest2);
}

/// Searches one pair from nothing but where its particles are.
void search_pair(const SurfaceCrowd& crowd, const std::vector<SearchedSurface>& searched, const SurfacePair& pair,
                 const CrowdState& state, PairTouches& touches) {
  const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
  if (pair.is_self()) {
    find_self(searched[a], self_rule(crowd, state, searched[a].particles, pair.first), pair.reach, touches.near_second);
  } else {
    find_near(searched[a], pair.shift, searched[b], pair.reach, touches.near_second);
    find_near(searched[b], -pair.shift, searched[a], pair.reach, touches.near_first);
  }
  touches.drift = 0, touches.steps = 0;
}

}  // namespace

float largest_drift(const SurfaceCrowd& crowd, const std::vector<const Particles*>& particles, const SurfacePair& pair,
                    const PairTouches& touches) {
  const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
  return std::max(largest_drift(touches.near_second, crowd.surfaces[b], *particles[a], *particles[b], pair.shift),
                  largest_drift(touches.near_first, crowd.surfaces[a], *particles[b], *particles[a], -pair.shift));
}

SelfRule self_rule(const SurfaceCrowd& crowd, const CrowdState& state, const Particles& particles, Index surface) {
  const auto at = static_cast<std::size_t>(surface);
  return {crowd.surfaces[at], crowd.rest[at], crowd.rest_normals[at],
          state.before[at],   particles,      crowd.neighborhood[at]};
}

void find_touches(const SurfaceCrowd& crowd, const std::vector<const Particles*>& particles, CrowdState& state) {
  std::vector<float> drifts(crowd.pairs.size());
  parallel_for_each(drifts.size(), [&](std::size_t i) {
    drifts[i] = state.touches[i].drift + largest_drift(crowd, particles, crowd.pairs[i], state.touches[i]);
  });
  std::vector<Index> lost;
  for (std::size_t i = 0; i < crowd.pairs.size(); ++i) {
    PairTouches& touches = state.touches[i];
    touches.is_new = true;
    const float drift = drifts[i];
    const bool is_trusted = drift <= trusted_share * crowd.pairs[i].reach && ++touches.steps < trusted_steps;
    if (!is_trusted) lost.push_back(static_cast<Index>(i));
  }
  std::vector<char> searched_for(particles.size(), 0);
  for (const Index i : lost) {
    const SurfacePair& pair = crowd.pairs[static_cast<std::size_t>(i)];
    for (const Index surface : {pair.first, pair.second}) searched_for[static_cast<std::size_t>(surface)] = 1;
  }
  parallel_for_each(particles.size(), [&](std::size_t s) {
    if (searched_for[s]) refit(crowd.surfaces[s], *particles[s], state.trees[s]);
  });
  std::vector<SearchedSurface> searched;
  for (std::size_t s = 0; s < particles.size(); ++s)
    searched.push_back({crowd.surfaces[s], *particles[s], state.trees[s]});
  parallel_for_each(lost.size(), [&](std::size_t i) {
    const auto number = static_cast<std::size_t>(lost[i]);
    search_pair(crowd, searched, crowd.pairs[number], state, state.touches[number]);
  });
}

}  // namespace gracilis
