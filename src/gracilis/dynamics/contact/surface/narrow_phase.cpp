#include <gracilis/dynamics/contact/surface/narrow_phase.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/contact/mesh/torn_particles.hpp>
#include <gracilis/dynamics/contact/surface/broad_phase.hpp>
#include <gracilis/dynamics/contact/surface/candidate_normals.hpp>
#include <gracilis/dynamics/contact/surface/edge_edge_search.hpp>
#include <gracilis/dynamics/contact/surface/overlap_release.hpp>
#include <gracilis/dynamics/contact/surface/vertex_face_search.hpp>

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
void walk(std::vector<VertexFaceCandidate>& near, const ExitSide& exit, const Particles& probe, const Particles& target,
          const Eigen::Vector3f& shift) {
  parallel_for(static_cast<Index>(near.size()), points_per_task, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      VertexFaceCandidate& candidate = near[static_cast<std::size_t>(i)];
      const Eigen::Vector3f p = probe.position(candidate.particle) + shift;
      note_nearest(p, exit.walk(candidate.particle, p, candidate.face, target), exit.surface, target, candidate);
    }
  });
}

OverlapRelease release_of(const ContactWorld& world, const SurfacePair& pair, const ContactWorldState& state,
                          bool toward_second) {
  const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
  if (toward_second)
    return {exit_of_first(world, pair), state.before[a], state.before[b], state.normals[b], pair.shift,
            pair.first_overlaps,        pair.release};
  return {exit_of_second(world, pair), state.before[b], state.before[a], state.normals[a], -pair.shift,
          pair.second_overlaps,        pair.release};
}

/// Lists those that could push before the next look. Within one surface a walk that ended among neighbors has found no
/// contact.
void list_near(std::vector<VertexFaceCandidate>& near, const ContactSurface& surface, const Eigen::Matrix3Xf& normals,
               const Particles& probe, const Particles& target, const Eigen::Vector3f& shift, float within,
               const std::vector<float>& gaps, const OverlapRelease& release, const SelfRule* self,
               std::vector<VertexFaceCandidate>& listed) {
  listed = collect_in_order<VertexFaceCandidate>(
      static_cast<Index>(near.size()), points_per_task,
      [&](Index begin, Index end, std::vector<VertexFaceCandidate>& part) {
        for (Index i = begin; i < end; ++i) {
          VertexFaceCandidate& candidate = near[static_cast<std::size_t>(i)];
          const PointGap gap = point_gap(probe.position(candidate.particle) + shift, surface,
                                         NearestFace{candidate.face, candidate.barycentric}, target, normals);
          candidate.distance = candidate.side * gap.distance;
          if (candidate.distance >= within) continue;
          if (self && self->side(candidate.particle, candidate.face) != candidate.side) continue;
          const float own =
              self ? self->most_gap(candidate.particle, candidate.face) : std::numeric_limits<float>::infinity();
          const float kept = std::min(own, gaps[static_cast<std::size_t>(candidate.particle)]);
          candidate.most_gap = std::min(kept, release.most_gap(candidate, kept));
          part.push_back(candidate);
        }
      });
}

/// Contact lets go of what is torn, so that it can come back to its neighbors.
void leave_out_torn(const ContactWorld& world, const SurfacePair& pair, const ContactWorldState& state,
                    PairCandidates& candidates) {
  const auto is_torn = [&](Index surface, Index particle) {
    return state.torn[static_cast<std::size_t>(surface)][static_cast<std::size_t>(particle)] != 0;
  };
  const auto drop = [&](std::vector<VertexFaceCandidate>& listed, Index probe, Index target) {
    std::erase_if(listed, [&](const VertexFaceCandidate& candidate) {
      const auto corners = world.surfaces[static_cast<std::size_t>(target)].faces.col(candidate.face);
      return is_torn(probe, candidate.particle) ||
             std::any_of(corners.begin(), corners.end(), [&](Index corner) { return is_torn(target, corner); });
    });
  };
  drop(candidates.on_second, pair.first, pair.second);
  drop(candidates.on_first, pair.second, pair.first);
  const auto has_torn_end = [&](Index surface, Index edge) {
    const auto& ends = world.surfaces[static_cast<std::size_t>(surface)].edges[static_cast<std::size_t>(edge)].ends;
    return is_torn(surface, ends[0]) || is_torn(surface, ends[1]);
  };
  std::erase_if(candidates.edges, [&](const EdgeEdgeCandidate& candidate) {
    return has_torn_end(pair.first, candidate.first) || has_torn_end(pair.second, candidate.second);
  });
}

/// Which way out each edge is from the other.
void note_outward(const SurfacePair& pair, const ContactWorld& world, const ContactWorldState& state,
                  std::vector<EdgeEdgeCandidate>& edges) {
  const auto normal_at = [&](Index surface, Index edge) -> Eigen::Vector3f {
    const auto at = static_cast<std::size_t>(surface);
    const auto& ends = world.surfaces[at].edges[static_cast<std::size_t>(edge)].ends;
    return state.normals[at].col(ends[0]) + state.normals[at].col(ends[1]);
  };
  for (EdgeEdgeCandidate& candidate : edges)
    candidate.outward =
        candidate.side * (normal_at(pair.second, candidate.second) - normal_at(pair.first, candidate.first));
}

/// Walks what is near of a pair to where it is now, unless so little moved that the last look's lists stay.
void walk_pair(const ContactWorld& world, const SurfacePair& pair, const std::vector<const Particles*>& particles,
               const Movers& movers, PairCandidates& candidates) {
  candidates.is_calm = !any_moves(pair, movers);
  if (candidates.is_calm) return;
  const float drift = largest_drift(world, particles, pair, candidates);
  candidates.is_calm = !candidates.is_new && !pair.is_self() && drift <= calm;
  if (candidates.is_calm) return;
  candidates.drift += drift;
  candidates.is_new = false;
  const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
  walk(candidates.near_second, exit_of_first(world, pair), *particles[a], *particles[b], pair.shift);
  walk(candidates.near_first, exit_of_second(world, pair), *particles[b], *particles[a], -pair.shift);
}

/// Lists what of a pair the next iterations have to project.
void list_pair(const ContactWorld& world, const SurfacePair& pair, const std::vector<const Particles*>& particles,
               const ContactWorldState& state, PairCandidates& candidates) {
  const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
  std::optional<SelfRule> self;
  if (pair.is_self()) self.emplace(self_rule(world, state, *particles[a], pair.first));
  const SelfRule* rule = self ? &*self : nullptr;
  // Cohesion also looks at what has parted.
  const float within = listed_within + (world.settings.cohesion > 0 && !self ? pair.reach : 0);
  list_near(candidates.near_second, world.surfaces[b], state.normals[b], *particles[a], *particles[b], pair.shift,
            within, pair.first_gap, release_of(world, pair, state, true), rule, candidates.on_second);
  list_near(candidates.near_first, world.surfaces[a], state.normals[a], *particles[b], *particles[a], -pair.shift,
            within, pair.second_gap, release_of(world, pair, state, false), rule, candidates.on_first);
  find_edges(world, pair, particles, state.before, candidates.near_second, rule, candidates.edges);
  leave_out_torn(world, pair, state, candidates);
}

}  // namespace

void update_narrow_phase(const ContactWorld& world, const std::vector<const Particles*>& particles,
                         ContactWorldState& state, const Movers& movers) {
  parallel_for_each(world.pairs.size(),
                    [&](std::size_t i) { walk_pair(world, world.pairs[i], particles, movers, state.candidates[i]); });
  parallel_for_each(particles.size(),
                    [&](std::size_t s) { add_torn(world.surfaces[s], world.rest[s], *particles[s], state.torn[s]); });
  NormalMaker normals(world, particles, state);
  ask_to_tell_sides(world, state, normals);
  normals.make();
  parallel_for_each(world.pairs.size(), [&](std::size_t i) {
    if (!state.candidates[i].is_calm) list_pair(world, world.pairs[i], particles, state, state.candidates[i]);
  });
  ask_to_project(world, state, normals);
  normals.make();
  parallel_for_each(world.pairs.size(), [&](std::size_t i) {
    if (!state.candidates[i].is_calm) note_outward(world.pairs[i], world, state, state.candidates[i].edges);
  });
}

}  // namespace gracilis
