#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/contact/mesh/torn_particles.hpp>
#include <gracilis/dynamics/contact/self/self_contact.hpp>
#include <gracilis/dynamics/contact/surface/edge_search.hpp>
#include <gracilis/dynamics/contact/surface/overlap_release.hpp>
#include <gracilis/dynamics/contact/surface/surface_contact.hpp>
#include <gracilis/dynamics/contact/surface/touch_search.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

/// What is near what: the searches behind surface_contact.hpp.
namespace gracilis {

namespace {

/// How the parts of a surface may meet in this step.
SelfRule self_rule(const SurfaceCrowd& crowd, const CrowdState& state, const Particles& particles, Index surface) {
  const auto at = static_cast<std::size_t>(surface);
  return {crowd.surfaces[at], crowd.rest[at], crowd.rest_normals[at],
          state.before[at],   particles,      crowd.neighborhood[at]};
}

constexpr Index chunk = 256;
/// What comes nearer than this beyond its gap is projected until the next look (m).
constexpr float listed_within = 0.0015f;
/// Two surfaces in which nothing has drifted farther than this since the last look are not looked at again (m): what
/// was too far away to be listed still is, even as an edge. One with itself always is: needles of hundredths of a
/// millimeter turn over.
constexpr float calm = 0.0005f;
/// A pair is searched again when something has drifted by this share of its reach since the search.
constexpr float trusted_share = 0.4f;
/// And after so many steps anyway: what is out of reach drifts unseen.
constexpr int trusted_steps = 3;
constexpr float infinity = std::numeric_limits<float>::infinity();

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

/// The same for both sides of a pair.
float largest_drift(const SurfaceCrowd& crowd, const std::vector<const Particles*>& particles, const SurfacePair& pair,
                    const PairTouches& touches) {
  const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
  return std::max(largest_drift(touches.near_second, crowd.surfaces[b], *particles[a], *particles[b], pair.shift),
                  largest_drift(touches.near_first, crowd.surfaces[a], *particles[b], *particles[a], -pair.shift));
}

/// Walks each to its nearest face.
void walk(std::vector<PointTouch>& near, const ContactSurface& surface, const Particles& probe, const Particles& target,
          const Eigen::Vector3f& shift) {
  parallel_for(static_cast<Index>(near.size()), chunk, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      PointTouch& touch = near[static_cast<std::size_t>(i)];
      const Eigen::Vector3f p = probe.position(touch.particle) + shift;
      note_nearest(p, walk_to_nearest(p, surface, touch.face, target), surface, target, touch);
    }
  });
}

OverlapRelease release_of(const SurfaceCrowd& crowd, const SurfacePair& pair, const CrowdState& state,
                          bool toward_second) {
  const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
  if (toward_second)
    return {crowd.surfaces[b], state.before[a],     state.before[b], state.normals[b],
            pair.shift,        pair.first_overlaps, pair.release};
  return {crowd.surfaces[a], state.before[b],      state.before[a], state.normals[a],
          -pair.shift,       pair.second_overlaps, pair.release};
}

/// Lists those that could push before the next look. Within one surface a walk that ended among neighbors has found no
/// contact.
void list_near(std::vector<PointTouch>& near, const ContactSurface& surface, const Eigen::Matrix3Xf& normals,
               const Particles& probe, const Particles& target, const Eigen::Vector3f& shift, float within,
               const std::vector<float>& gaps, const OverlapRelease& release, const SelfRule* self,
               std::vector<PointTouch>& listed) {
  listed = collect_in_order<PointTouch>(
      static_cast<Index>(near.size()), chunk, [&](Index begin, Index end, std::vector<PointTouch>& part) {
        for (Index i = begin; i < end; ++i) {
          PointTouch& touch = near[static_cast<std::size_t>(i)];
          const PointGap gap = point_gap(probe.position(touch.particle) + shift, surface,
                                         NearestFace{touch.face, touch.barycentric}, target, normals);
          touch.distance = touch.side * gap.distance;
          if (touch.distance >= within) continue;
          if (self && self->side(touch.particle, touch.face) != touch.side) continue;
          const float own = self ? self->most_gap(touch.particle, touch.face) : infinity;
          const float kept = std::min(own, gaps[static_cast<std::size_t>(touch.particle)]);
          touch.most_gap = std::min(kept, release.most_gap(touch, kept));
          part.push_back(touch);
        }
      });
}

/// Makes the normals that are asked for, each once. Others are those of some earlier time and nobody's business.
class NormalMaker {
 public:
  NormalMaker(const SurfaceCrowd& crowd, const std::vector<const Particles*>& particles, CrowdState& state)
      : crowd_(crowd), particles_(particles), state_(state), asked_(particles.size()), listed_(particles.size()) {
    for (std::size_t s = 0; s < particles.size(); ++s)
      asked_[s].resize(static_cast<std::size_t>(particles[s]->count()), 0);
  }

  void ask(std::size_t surface, Index particle) {
    char& asked = asked_[surface][static_cast<std::size_t>(particle)];
    if (!asked) listed_[surface].push_back(particle);
    asked = 1;
  }
  void ask_corners(std::size_t surface, const PointTouch& touch) {
    for (const Index corner : crowd_.surfaces[surface].faces.col(touch.face)) ask(surface, corner);
  }
  void ask_ends(std::size_t surface, Index edge) {
    for (const Index end : crowd_.surfaces[surface].edges[static_cast<std::size_t>(edge)].ends) ask(surface, end);
  }

  void make() {
    parallel_for_each(listed_.size(), [&](std::size_t s) {
      particle_normals(crowd_.surfaces[s], *particles_[s], listed_[s], state_.normals[s]);
      listed_[s].clear();
    });
  }

 private:
  const SurfaceCrowd& crowd_;
  const std::vector<const Particles*>& particles_;
  CrowdState& state_;
  std::vector<std::vector<char>> asked_;
  std::vector<std::vector<Index>> listed_;
};

/// The normals that tell on which side of a surface those near it are; over the inside of a face it tells alone.
void ask_to_tell_sides(const SurfaceCrowd& crowd, const CrowdState& state, NormalMaker& normals) {
  const auto ask = [&](std::size_t target, const std::vector<PointTouch>& near) {
    for (const PointTouch& touch : near)
      if (!(touch.barycentric.minCoeff() > 0)) normals.ask_corners(target, touch);
  };
  for (std::size_t i = 0; i < crowd.pairs.size(); ++i) {
    if (state.touches[i].is_calm) continue;
    ask(static_cast<std::size_t>(crowd.pairs[i].second), state.touches[i].near_second);
    ask(static_cast<std::size_t>(crowd.pairs[i].first), state.touches[i].near_first);
  }
}

/// The normals that projecting what is listed may need.
void ask_to_project(const SurfaceCrowd& crowd, const CrowdState& state, NormalMaker& normals) {
  for (std::size_t i = 0; i < crowd.pairs.size(); ++i) {
    if (state.touches[i].is_calm) continue;
    const auto first = static_cast<std::size_t>(crowd.pairs[i].first),
               second = static_cast<std::size_t>(crowd.pairs[i].second);
    for (const PointTouch& touch : state.touches[i].on_second) normals.ask_corners(second, touch);
    for (const PointTouch& touch : state.touches[i].on_first) normals.ask_corners(first, touch);
    for (const EdgeTouch& touch : state.touches[i].edges) {
      normals.ask_ends(first, touch.first);
      normals.ask_ends(second, touch.second);
    }
  }
}

/// Contact lets go of what is torn, so that it can come back to its neighbors.
void leave_out_torn(const SurfaceCrowd& crowd, const SurfacePair& pair, const CrowdState& state, PairTouches& touches) {
  const auto is_torn = [&](Index surface, Index particle) {
    return state.torn[static_cast<std::size_t>(surface)][static_cast<std::size_t>(particle)] != 0;
  };
  const auto drop = [&](std::vector<PointTouch>& listed, Index probe, Index target) {
    std::erase_if(listed, [&](const PointTouch& touch) {
      const auto corners = crowd.surfaces[static_cast<std::size_t>(target)].faces.col(touch.face);
      return is_torn(probe, touch.particle) ||
             std::any_of(corners.begin(), corners.end(), [&](Index corner) { return is_torn(target, corner); });
    });
  };
  drop(touches.on_second, pair.first, pair.second);
  drop(touches.on_first, pair.second, pair.first);
  const auto has_torn_end = [&](Index surface, Index edge) {
    const auto& ends = crowd.surfaces[static_cast<std::size_t>(surface)].edges[static_cast<std::size_t>(edge)].ends;
    return is_torn(surface, ends[0]) || is_torn(surface, ends[1]);
  };
  std::erase_if(touches.edges, [&](const EdgeTouch& touch) {
    return has_torn_end(pair.first, touch.first) || has_torn_end(pair.second, touch.second);
  });
}

/// Which way out each edge is from the other.
void note_outward(const SurfacePair& pair, const SurfaceCrowd& crowd, const CrowdState& state,
                  std::vector<EdgeTouch>& edges) {
  const auto normal_at = [&](Index surface, Index edge) -> Eigen::Vector3f {
    const auto at = static_cast<std::size_t>(surface);
    const auto& ends = crowd.surfaces[at].edges[static_cast<std::size_t>(edge)].ends;
    return state.normals[at].col(ends[0]) + state.normals[at].col(ends[1]);
  };
  for (EdgeTouch& touch : edges)
    touch.outward = touch.side * (normal_at(pair.second, touch.second) - normal_at(pair.first, touch.first));
}

}  // namespace

CrowdState make_crowd_state(const SurfaceCrowd& crowd) {
  CrowdState state;
  for (const Eigen::Matrix3Xf& rest : crowd.rest)
    state.before.push_back(make_particles(rest.cast<Real>(), Eigen::VectorXd::Zero(rest.cols())));
  for (std::size_t s = 0; s < crowd.surfaces.size(); ++s)
    state.trees.push_back(build_patch_tree(crowd.surfaces[s], crowd.rest[s]));
  state.normals = crowd.rest_normals;
  for (const Particles& particles : state.before)
    state.torn.emplace_back(static_cast<std::size_t>(particles.count()), 0);
  state.touches.resize(crowd.pairs.size());
  return state;
}

void remember_places(const std::vector<const Particles*>& particles, CrowdState& state) {
  for (std::size_t s = 0; s < particles.size(); ++s) {
    state.before[s] = *particles[s];
    std::fill(state.torn[s].begin(), state.torn[s].end(), 0);
  }
}

void begin_touch_frame(const SurfaceCrowd& crowd, CrowdState& state) {
  if (state.frames % crowd.settings.update_period == 0) forget_touches(state);
  ++state.frames;
}

void forget_touches(CrowdState& state) {
  for (PairTouches& touches : state.touches) touches.drift = infinity;
  state.frames = 0;
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
    const SurfacePair& pair = crowd.pairs[number];
    PairTouches& touches = state.touches[number];
    const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
    if (pair.is_self()) {
      find_self(searched[a], self_rule(crowd, state, *particles[a], pair.first), pair.reach, touches.near_second);
    } else {
      find_near(searched[a], pair.shift, searched[b], pair.reach, touches.near_second);
      find_near(searched[b], -pair.shift, searched[a], pair.reach, touches.near_first);
    }
    touches.drift = 0, touches.steps = 0;
  });
}

void follow_touches(const SurfaceCrowd& crowd, const std::vector<const Particles*>& particles, CrowdState& state,
                    const Movers& movers) {
  parallel_for_each(crowd.pairs.size(), [&](std::size_t i) {
    const SurfacePair& pair = crowd.pairs[i];
    PairTouches& touches = state.touches[i];
    touches.is_calm = !any_moves(pair, movers);
    if (touches.is_calm) return;
    const float drift = largest_drift(crowd, particles, pair, touches);
    touches.is_calm = !touches.is_new && !pair.is_self() && drift <= calm;
    if (touches.is_calm) return;
    touches.drift += drift;
    touches.is_new = false;
    const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
    walk(touches.near_second, crowd.surfaces[b], *particles[a], *particles[b], pair.shift);
    walk(touches.near_first, crowd.surfaces[a], *particles[b], *particles[a], -pair.shift);
  });
  parallel_for_each(particles.size(),
                    [&](std::size_t s) { add_torn(crowd.surfaces[s], crowd.rest[s], *particles[s], state.torn[s]); });
  NormalMaker normals(crowd, particles, state);
  ask_to_tell_sides(crowd, state, normals);
  normals.make();
  parallel_for_each(crowd.pairs.size(), [&](std::size_t i) {
    const SurfacePair& pair = crowd.pairs[i];
    PairTouches& touches = state.touches[i];
    if (touches.is_calm) return;
    const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
    std::optional<SelfRule> self;
    if (pair.is_self()) self.emplace(self_rule(crowd, state, *particles[a], pair.first));
    const SelfRule* rule = self ? &*self : nullptr;
    // Cohesion also looks at what has parted.
    const float within = listed_within + (crowd.settings.cohesion > 0 && !self ? pair.reach : 0);
    list_near(touches.near_second, crowd.surfaces[b], state.normals[b], *particles[a], *particles[b], pair.shift,
              within, pair.first_gap, release_of(crowd, pair, state, true), rule, touches.on_second);
    list_near(touches.near_first, crowd.surfaces[a], state.normals[a], *particles[b], *particles[a], -pair.shift,
              within, pair.second_gap, release_of(crowd, pair, state, false), rule, touches.on_first);
    find_edges(crowd, pair, particles, state.before, touches.near_second, rule, touches.edges);
    leave_out_torn(crowd, pair, state, touches);
  });
  ask_to_project(crowd, state, normals);
  normals.make();
  parallel_for_each(crowd.pairs.size(), [&](std::size_t i) {
    if (!state.touches[i].is_calm) note_outward(crowd.pairs[i], crowd, state, state.touches[i].edges);
  });
}

}  // namespace gracilis
