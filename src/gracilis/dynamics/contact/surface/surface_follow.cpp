#include <gracilis/dynamics/contact/surface/surface_follow.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/contact/mesh/torn_particles.hpp>
#include <gracilis/dynamics/contact/surface/edge_search.hpp>
#include <gracilis/dynamics/contact/surface/overlap_release.hpp>
#include <gracilis/dynamics/contact/surface/surface_search.hpp>
#include <gracilis/dynamics/contact/surface/touch_normals.hpp>
#include <gracilis/dynamics/contact/surface/touch_search.hpp>

#include <algorithm>
#include <limits>
#include <optional>

namespace gracilis {

namespace {

constexpr Index points_per_task = 256;
/// What comes nearer than this beyond its gap is projected until the next look (m).
constexpr float listed_within = 0.0015f;
/// Two surfaces in which nothing has drifted farther than this since the last look are not looked at again (m): what
/// was too far away to be listed still is, even as an edge. One with itself always is: needles of hundredths of a
/// millimeter turn over.
constexpr float calm = 0.0005f;

/// Walks each to its nearest face.
void walk(std::vector<PointTouch>& near, const ContactSurface& surface, const Particles& probe, const Particles& target,
          const Eigen::Vector3f& shift) {
  parallel_for(static_cast<Index>(near.size()), points_per_task, [&](Index begin, Index end) {
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
      static_cast<Index>(near.size()), points_per_task, [&](Index begin, Index end, std::vector<PointTouch>& part) {
        for (Index i = begin; i < end; ++i) {
          PointTouch& touch = near[static_cast<std::size_t>(i)];
          const PointGap gap = point_gap(probe.position(touch.particle) + shift, surface,
                                         NearestFace{touch.face, touch.barycentric}, target, normals);
          touch.distance = touch.side * gap.distance;
          if (touch.distance >= within) continue;
          if (self && self->side(touch.particle, touch.face) != touch.side) continue;
          const float own = self ? self->most_gap(touch.particle, touch.face) : std::numeric_limits<float>::infinity();
          const float kept = std::min(own, gaps[static_cast<std::size_t>(touch.particle)]);
          touch.most_gap = std::min(kept, release.most_gap(touch, kept));
          part.push_back(touch);
        }
      });
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

/// Walks what is near of a pair to where it is now, unless so little moved that the last look's lists stay.
void walk_pair(const SurfaceCrowd& crowd, const SurfacePair& pair, const std::vector<const Particles*>& particles,
               const Movers& movers, PairTouches& touches) {
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
}

/// Lists what of a pair the next iterations have to project.
void list_pair(const SurfaceCrowd& crowd, const SurfacePair& pair, const std::vector<const Particles*>& particles,
               const CrowdState& state, PairTouches& touches) {
  const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
  std::optional<SelfRule> self;
  if (pair.is_self()) self.emplace(self_rule(crowd, state, *particles[a], pair.first));
  const SelfRule* rule = self ? &*self : nullptr;
  // Cohesion also looks at what has parted.
  const float within = listed_within + (crowd.settings.cohesion > 0 && !self ? pair.reach : 0);
  list_near(touches.near_second, crowd.surfaces[b], state.normals[b], *particles[a], *particles[b], pair.shift, within,
            pair.first_gap, release_of(crowd, pair, state, true), rule, touches.on_second);
  list_near(touches.near_first, crowd.surfaces[a], state.normals[a], *particles[b], *particles[a], -pair.shift, within,
            pair.second_gap, release_of(crowd, pair, state, false), rule, touches.on_first);
  find_edges(crowd, pair, particles, state.before, touches.near_second, rule, touches.edges);
  leave_out_torn(crowd, pair, state, touches);
}

}  // namespace

void follow_touches(const SurfaceCrowd& crowd, const std::vector<const Particles*>& particles, CrowdState& state,
                    const Movers& movers) {
  parallel_for_each(crowd.pairs.size(),
                    [&](std::size_t i) { walk_pair(crowd, crowd.pairs[i], particles, movers, state.touches[i]); });
  parallel_for_each(particles.size(),
                    [&](std::size_t s) { add_torn(crowd.surfaces[s], crowd.rest[s], *particles[s], state.torn[s]); });
  NormalMaker normals(crowd, particles, state);
  ask_to_tell_sides(crowd, state, normals);
  normals.make();
  parallel_for_each(crowd.pairs.size(), [&](std::size_t i) {
    if (!state.touches[i].is_calm) list_pair(crowd, crowd.pairs[i], particles, state, state.touches[i]);
  });
  ask_to_project(crowd, state, normals);
  normals.make();
  parallel_for_each(crowd.pairs.size(), [&](std::size_t i) {
    if (!state.touches[i].is_calm) note_outward(crowd.pairs[i], crowd, state, state.touches[i].edges);
  });
}

}  // namespace gracilis
