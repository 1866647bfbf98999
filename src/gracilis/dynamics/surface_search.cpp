#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/edge_crossings.hpp>
#include <gracilis/dynamics/self_contact.hpp>
#include <gracilis/dynamics/surface_contact.hpp>
#include <gracilis/dynamics/touch_search.hpp>

#include <algorithm>
#include <optional>

/// What is near what: the searches behind surface_contact.hpp.
namespace gracilis {

namespace {

constexpr Index chunk = 256;
/// What comes nearer than this beyond its gap is projected until the next look (m).
constexpr float listed_within = 0.0015f;
/// The same for edges, of which there are three times as many; between two looks they hardly come nearer by more.
constexpr float edges_listed_within = 0.0008f;
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Walks each to its nearest face.
void walk(std::vector<PointTouch>& near, const ContactSurface& surface, const Particles& probe, const Particles& target,
          const Eigen::Vector3f& shift) {
  parallel_for(static_cast<Index>(near.size()), chunk, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      PointTouch& touch = near[static_cast<std::size_t>(i)];
      const NearestFace nearest = walk_to_nearest(probe.position(touch.particle) + shift, surface, touch.face, target);
      touch.face = nearest.face;
      touch.barycentric = nearest.barycentric;
    }
  });
}

/// Lists those that could push before the next look. Within one surface a walk that ended among neighbors has found no
/// contact.
void list_near(std::vector<PointTouch>& near, const ContactSurface& surface, const Eigen::Matrix3Xf& normals,
               const Particles& probe, const Particles& target, const Eigen::Vector3f& shift, float within,
               const SelfRule* self, std::vector<PointTouch>& listed) {
  listed = collect_in_order<PointTouch>(
      static_cast<Index>(near.size()), chunk, [&](Index begin, Index end, std::vector<PointTouch>& part) {
        for (Index i = begin; i < end; ++i) {
          PointTouch& touch = near[static_cast<std::size_t>(i)];
          const PointGap gap = point_gap(probe.position(touch.particle) + shift, surface,
                                         NearestFace{touch.face, touch.barycentric}, target, normals);
          touch.distance = touch.side * gap.distance;
          if (touch.distance >= within) continue;
          if (self && self->side(touch.particle, touch.face) != touch.side) continue;
          if (self) touch.most_gap = self->most_gap(touch.particle, touch.face);
          part.push_back(touch);
        }
      });
}

/// The edges of a face and of the faces behind its sides.
void gather_edges(const ContactSurface& surface, Index face, std::vector<Index>& edges) {
  for (int corner = 0; corner < 3; ++corner) {
    const Index side = surface.sides(corner, face), behind = surface.across(corner, face);
    edges.push_back(side);
    if (behind < 0) continue;
    for (const Index other : surface.sides.col(behind))
      if (other != side) edges.push_back(other);
  }
}

/// Sum of the unit normals of an edge's faces.
Eigen::Vector3f edge_normal(const ContactSurface& surface, Index edge, const Particles& particles) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const Index face : surface.edges[static_cast<std::size_t>(edge)].faces) {
    if (face < 0) continue;
    sum += face_area(surface, face, particles).normalized();
  }
  return sum;
}

/// Whether a particle is so near that an edge of this length from it may cross another closely: one that does has an
/// end within half of its length and that.
bool is_near_enough(const PointTouch& touch, float length2) {
  const float beyond = touch.distance - edges_listed_within;
  return beyond < 0 || 4 * beyond * beyond < length2;
}

/// Looks up what a particle is near.
class TouchTable {
 public:
  TouchTable(const std::vector<PointTouch>& near, Index particle_count)
      : near_(near), at_(static_cast<std::size_t>(particle_count), -1) {
    for (std::size_t i = 0; i < near.size(); ++i)
      at_[static_cast<std::size_t>(near[i].particle)] = static_cast<Index>(i);
  }

  /// What this end of an edge is near if the edge may cross another closely by it, else null.
  const PointTouch* near_enough(Index end, float length2) const {
    const Index at = at_[static_cast<std::size_t>(end)];
    if (at < 0) return nullptr;
    const PointTouch& touch = near_[static_cast<std::size_t>(at)];
    return is_near_enough(touch, length2) ? &touch : nullptr;
  }

 private:
  const std::vector<PointTouch>& near_;
  std::vector<Index> at_;
};

/// The edges that may cross others closely by what their ends are near, each once.
std::vector<Index> edges_around(const std::vector<PointTouch>& near, const TouchTable& table,
                                const ContactSurface& surface, const Particles& particles) {
  return collect_in_order<Index>(
      static_cast<Index>(near.size()), chunk, [&](Index begin, Index end, std::vector<Index>& part) {
        for (Index i = begin; i < end; ++i) {
          const PointTouch& touch = near[static_cast<std::size_t>(i)];
          const auto at = static_cast<std::size_t>(touch.particle);
          for (Index k = surface.spoke_offsets[at]; k < surface.spoke_offsets[at + 1]; ++k) {
            const Index edge = surface.spokes[static_cast<std::size_t>(k)];
            const auto& ends = surface.edges[static_cast<std::size_t>(edge)].ends;
            const float length2 = (particles.position(ends[1]) - particles.position(ends[0])).squaredNorm();
            if (!is_near_enough(touch, length2)) continue;
            // By its first end unless that is too far away.
            if (ends[0] == touch.particle || !table.near_enough(ends[0], length2)) part.push_back(edge);
          }
        }
      });
}

/// Pairs of edges, one of each surface, that cross closely. Within one surface `self` tells which parts may meet.
void find_edges(const SurfaceCrowd& crowd, const SurfacePair& pair, const std::vector<const Particles*>& particles,
                const std::vector<PointTouch>& near_second, const SelfRule* self, std::vector<EdgeTouch>& found) {
  const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
  const ContactSurface &first = crowd.surfaces[a], &second = crowd.surfaces[b];
  found.clear();
  if (near_second.empty()) return;
  const TouchTable table(near_second, particles[a]->count());
  const std::vector<Index> edges = edges_around(near_second, table, first, *particles[a]);
  const auto count = static_cast<Index>(edges.size());
  found = collect_in_order<EdgeTouch>(count, chunk, [&](Index begin, Index end, std::vector<EdgeTouch>& part) {
    std::vector<Index> candidates;
    for (Index i = begin; i < end; ++i) {
      const Index e = edges[static_cast<std::size_t>(i)];
      const auto& ends = first.edges[static_cast<std::size_t>(e)].ends;
      const Segment edge = {particles[a]->position(ends[0]) + pair.shift, particles[a]->position(ends[1]) + pair.shift};
      const auto segment_of = [&](Index other) -> Segment {
        const auto& its_ends = second.edges[static_cast<std::size_t>(other)].ends;
        return {particles[b]->position(its_ends[0]), particles[b]->position(its_ends[1])};
      };
      candidates.clear();
      Index gathered = -1;
      for (const Index particle : ends) {
        const PointTouch* touch = table.near_enough(particle, edge.length2());
        if (!touch || touch->face == gathered) continue;
        if (self && self->side(particle, touch->face) != touch->side) continue;
        gather_edges(second, touch->face, candidates);
        gathered = touch->face;
      }
      keep_crossing(edge, edges_listed_within, second, *particles[b], candidates);
      if (candidates.empty()) continue;
      std::sort(candidates.begin(), candidates.end());
      candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
      const Eigen::Vector3f own_normal = edge_normal(first, e, *particles[a]);
      for (Index candidate : candidates) {
        const auto& other = second.edges[static_cast<std::size_t>(candidate)].ends;
        const float side = self ? self->side(ends, other) : 1.0f;
        if (side == 0) continue;
        const Eigen::Vector3f outward = side * (edge_normal(second, candidate, *particles[b]) - own_normal);
        const Segment its = segment_of(candidate);
        const EdgeGap gap = edge_gap(edge.from, edge.to, its.from, its.to, outward);
        if (gap.crossing && std::abs(gap.distance) < edges_listed_within)
          part.push_back({e, candidate, side, self ? self->most_gap(ends, other) : infinity});
      }
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
    ask(static_cast<std::size_t>(crowd.pairs[i].second), state.touches[i].near_second);
    ask(static_cast<std::size_t>(crowd.pairs[i].first), state.touches[i].near_first);
  }
}

/// The normals that projecting what is listed may need.
void ask_to_project(const SurfaceCrowd& crowd, const CrowdState& state, NormalMaker& normals) {
  for (std::size_t i = 0; i < crowd.pairs.size(); ++i) {
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

}  // namespace

CrowdState make_crowd_state(const SurfaceCrowd& crowd) {
  CrowdState state;
  state.before = crowd.rest;
  for (std::size_t s = 0; s < crowd.surfaces.size(); ++s)
    state.trees.push_back(build_patch_tree(crowd.surfaces[s], crowd.rest[s]));
  state.normals = crowd.rest_normals;
  state.touches.resize(crowd.pairs.size());
  return state;
}

void remember_places(const std::vector<const Particles*>& particles, CrowdState& state) {
  for (std::size_t s = 0; s < particles.size(); ++s)
    for (Index p = 0; p < particles[s]->count(); ++p) state.before[s].col(p) = particles[s]->position(p);
}

void find_touches(const SurfaceCrowd& crowd, const std::vector<const Particles*>& particles, CrowdState& state) {
  std::vector<SearchedSurface> searched;
  for (std::size_t s = 0; s < particles.size(); ++s) searched.push_back({*particles[s], state.trees[s]});
  parallel_for_each(particles.size(), [&](std::size_t s) { refit(crowd.surfaces[s], *particles[s], state.trees[s]); });
  parallel_for_each(crowd.pairs.size(), [&](std::size_t i) {
    const SurfacePair& pair = crowd.pairs[i];
    PairTouches& touches = state.touches[i];
    const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
    if (pair.is_self()) {
      find_self(searched[a], self_rule(crowd, state, *particles[a], pair.first), pair.reach, touches.near_second);
    } else {
      find_near(searched[a], pair.shift, searched[b], pair.reach, touches.near_second);
      find_near(searched[b], -pair.shift, searched[a], pair.reach, touches.near_first);
    }
  });
}

void follow_touches(const SurfaceCrowd& crowd, const std::vector<const Particles*>& particles, CrowdState& state) {
  parallel_for_each(crowd.pairs.size(), [&](std::size_t i) {
    const SurfacePair& pair = crowd.pairs[i];
    PairTouches& touches = state.touches[i];
    const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
    walk(touches.near_second, crowd.surfaces[b], *particles[a], *particles[b], pair.shift);
    walk(touches.near_first, crowd.surfaces[a], *particles[b], *particles[a], -pair.shift);
  });
  NormalMaker normals(crowd, particles, state);
  ask_to_tell_sides(crowd, state, normals);
  normals.make();
  parallel_for_each(crowd.pairs.size(), [&](std::size_t i) {
    const SurfacePair& pair = crowd.pairs[i];
    PairTouches& touches = state.touches[i];
    const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
    std::optional<SelfRule> self;
    if (pair.is_self()) self.emplace(self_rule(crowd, state, *particles[a], pair.first));
    const SelfRule* rule = self ? &*self : nullptr;
    // Cohesion also looks at what has parted.
    const float within = listed_within + (crowd.settings.cohesion > 0 && !self ? pair.reach : 0);
    list_near(touches.near_second, crowd.surfaces[b], state.normals[b], *particles[a], *particles[b], pair.shift,
              within, rule, touches.on_second);
    list_near(touches.near_first, crowd.surfaces[a], state.normals[a], *particles[b], *particles[a], -pair.shift,
              within, rule, touches.on_first);
    find_edges(crowd, pair, particles, touches.near_second, rule, touches.edges);
  });
  ask_to_project(crowd, state, normals);
  normals.make();
}

}  // namespace gracilis
