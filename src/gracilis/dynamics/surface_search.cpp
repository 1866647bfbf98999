#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/surface_contact.hpp>

#include <algorithm>

/// What is near what: the searches behind surface_contact.hpp.
namespace gracilis {

namespace {

constexpr Index chunk = 256;
/// What comes nearer than this beyond its gap is projected until the next look (m).
constexpr float listed_within = 0.0015f;
/// Parts of a surface that lie back to back farther apart than this at rest, in neighborhoods, meet from outside.
constexpr float thickest_sheet = 2;

using Box = Eigen::AlignedBox3f;

Box box_around(const Particles& particles) {
  Box box;
  for (Index p = 0; p < particles.count(); ++p) box.extend(Eigen::Vector3f(particles.position(p)));
  return box;
}

/// Fills `found` with accept(i) for each i of [0, count) that it takes, in order.
template <class Search>
void search_all(Index count, const Search& search, std::vector<PointTouch>& found) {
  const Index chunks = (count + chunk - 1) / chunk;
  std::vector<std::vector<PointTouch>> parts(static_cast<std::size_t>(chunks));
  parallel_for(count, chunk, [&](Index begin, Index end) {
    std::vector<PointTouch>& part = parts[static_cast<std::size_t>(begin / chunk)];
    for (Index i = begin; i < end; ++i) search(i, part);
  });
  found.clear();
  for (const std::vector<PointTouch>& part : parts) found.insert(found.end(), part.begin(), part.end());
}

void find_near(const Particles& probe, const Eigen::Vector3f& shift, const NearestTriangle& target,
               const Box& target_box, float reach, std::vector<PointTouch>& found) {
  search_all(
      probe.count(),
      [&](Index p, std::vector<PointTouch>& part) {
        const Eigen::Vector3f x = probe.position(p) + shift;
        if (target_box.squaredExteriorDistance(x) > reach * reach) return;
        const NearestPoint nearest = target.query(x.cast<Real>(), reach);
        if (nearest.face >= 0) part.push_back({p, nearest.face, 1});
      },
      found);
}

/// How a particle and a face of the same surface may meet: 1 from outside where the surface folds, -1 from inside where
/// it is a sheet and the face its back, 0 not at all because they are neighbors.
struct SelfRule {
  const ContactSurface& surface;
  const Eigen::Matrix3Xf &rest, &rest_normals, &normals;
  float neighborhood;

  float side(Index particle, Index face) const {
    const Eigen::Vector3i corners = surface.faces.col(face);
    if (corners[0] == particle || corners[1] == particle || corners[2] == particle) return 0;
    const Eigen::Vector3f facing = normals.col(corners[0]) + normals.col(corners[1]) + normals.col(corners[2]);
    // Parts that face the same way lie side by side.
    if (facing.dot(normals.col(particle)) >= 0) return 0;
    Eigen::Vector3f away = rest.col(corners[0]) - rest.col(particle);  // to the nearest corner
    for (const Index corner : {corners[1], corners[2]}) {
      const Eigen::Vector3f other = rest.col(corner) - rest.col(particle);
      if (other.squaredNorm() < away.squaredNorm()) away = other;
    }
    const Eigen::Vector3f rest_facing =
        rest_normals.col(corners[0]) + rest_normals.col(corners[1]) + rest_normals.col(corners[2]);
    const auto own = rest_normals.col(particle);
    const float neighborhoods = away.norm() / neighborhood;
    const bool through = away.dot(own) < 0 && away.dot(rest_facing) > 0 && neighborhoods < thickest_sheet;
    const bool alike = rest_facing.dot(own) > 1.5f;
    if (through && !alike) return -1;
    return neighborhoods > 1 ? 1.0f : 0.0f;
  }
};

SelfRule self_rule(const SurfaceCrowd& crowd, const CrowdState& state, Index surface) {
  const auto at = static_cast<std::size_t>(surface);
  return {crowd.surfaces[at], crowd.rest[at], crowd.rest_normals[at], state.normals[at], crowd.neighborhood[at]};
}

void find_self(const SelfRule& rule, const Particles& particles, const NearestTriangle& tree, float reach,
               std::vector<PointTouch>& found) {
  search_all(
      particles.count(),
      [&](Index p, std::vector<PointTouch>& part) {
        const std::function<bool(Index)> accepts = [&](Index face) { return rule.side(p, face) != 0; };
        const NearestPoint nearest = tree.query(particles.position(p).cast<Real>(), reach, accepts);
        if (nearest.face >= 0) part.push_back({p, nearest.face, rule.side(p, nearest.face)});
      },
      found);
}

/// Walks each to its nearest face and lists those that could push before the next look. Within one surface a walk that
/// ends among neighbors has found no contact.
void follow(std::vector<PointTouch>& near, const ContactSurface& target_surface, const Eigen::Matrix3Xf& target_normals,
            const Particles& probe, const Particles& target, const Eigen::Vector3f& shift, float within,
            const SelfRule* self, std::vector<PointTouch>& listed) {
  search_all(
      static_cast<Index>(near.size()),
      [&](Index i, std::vector<PointTouch>& part) {
        PointTouch& touch = near[static_cast<std::size_t>(i)];
        const Eigen::Vector3f x = probe.position(touch.particle) + shift;
        const Index face = walk_to_nearest(x, target_surface, touch.face, target);
        if (self && self->side(touch.particle, face) != touch.side) return;
        touch.face = face;
        const PointGap gap = point_gap(x, target_surface, face, target, target_normals);
        if (touch.side * gap.distance < within) part.push_back(touch);
      },
      listed);
}

/// The edges of a face and of the faces behind its sides.
void gather_edges(const ContactSurface& surface, Index face, std::vector<Index>& edges) {
  for (int corner = 0; corner < 3; ++corner) {
    edges.push_back(surface.sides(corner, face));
    const Index behind = surface.across(corner, face);
    if (behind < 0) continue;
    for (int side = 0; side < 3; ++side) edges.push_back(surface.sides(side, behind));
  }
}

/// Pairs of edges, one of each surface, that cross closely.
void find_edges(const SurfaceCrowd& crowd, const SurfacePair& pair, const std::vector<const Particles*>& particles,
                const std::vector<Eigen::Matrix3Xf>& normals, const std::vector<PointTouch>& near_second,
                std::vector<EdgeTouch>& found) {
  const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
  const ContactSurface &first = crowd.surfaces[a], &second = crowd.surfaces[b];
  std::vector<Index> face_near(static_cast<std::size_t>(particles[a]->count()), -1);
  for (const PointTouch& touch : near_second) face_near[static_cast<std::size_t>(touch.particle)] = touch.face;
  const auto count = static_cast<Index>(first.edges.size());
  std::vector<std::vector<EdgeTouch>> parts(static_cast<std::size_t>((count + chunk - 1) / chunk));
  parallel_for(count, chunk, [&](Index begin, Index end) {
    std::vector<EdgeTouch>& part = parts[static_cast<std::size_t>(begin / chunk)];
    std::vector<Index> candidates;
    for (Index e = begin; e < end; ++e) {
      const auto& ends = first.edges[static_cast<std::size_t>(e)].ends;
      candidates.clear();
      for (Index end_particle : ends) {
        const Index face = face_near[static_cast<std::size_t>(end_particle)];
        if (face >= 0) gather_edges(second, face, candidates);
      }
      if (candidates.empty()) continue;
      std::sort(candidates.begin(), candidates.end());
      candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
      const Eigen::Vector3f a0 = particles[a]->position(ends[0]) + pair.shift,
                            a1 = particles[a]->position(ends[1]) + pair.shift;
      for (Index candidate : candidates) {
        const auto& other = second.edges[static_cast<std::size_t>(candidate)].ends;
        const Eigen::Vector3f outward =
            normals[b].col(other[0]) + normals[b].col(other[1]) - normals[a].col(ends[0]) - normals[a].col(ends[1]);
        const EdgeGap gap =
            edge_gap(a0, a1, particles[b]->position(other[0]), particles[b]->position(other[1]), outward);
        if (gap.crossing && std::abs(gap.distance) < listed_within) part.push_back({e, candidate});
      }
    }
  });
  found.clear();
  for (const std::vector<EdgeTouch>& part : parts) found.insert(found.end(), part.begin(), part.end());
}

/// Normals where surfaces are near each other; elsewhere those of the step's beginning do.
void refresh_normals(const SurfaceCrowd& crowd, const std::vector<const Particles*>& particles, CrowdState& state) {
  std::vector<std::vector<char>> wanted(crowd.surfaces.size());
  for (std::size_t s = 0; s < wanted.size(); ++s) wanted[s].assign(static_cast<std::size_t>(particles[s]->count()), 0);
  const auto want = [&](const std::vector<PointTouch>& near, std::size_t probe, std::size_t target) {
    for (const PointTouch& touch : near) {
      wanted[probe][static_cast<std::size_t>(touch.particle)] = 1;
      for (Index corner : crowd.surfaces[target].faces.col(touch.face))
        wanted[target][static_cast<std::size_t>(corner)] = 1;
    }
  };
  for (std::size_t i = 0; i < crowd.pairs.size(); ++i) {
    const auto a = static_cast<std::size_t>(crowd.pairs[i].first), b = static_cast<std::size_t>(crowd.pairs[i].second);
    want(state.touches[i].near_second, a, b);
    want(state.touches[i].near_first, b, a);
  }
  std::vector<Index> listed;
  for (std::size_t s = 0; s < wanted.size(); ++s) {
    listed.clear();
    for (std::size_t p = 0; p < wanted[s].size(); ++p)
      if (wanted[s][p]) listed.push_back(static_cast<Index>(p));
    particle_normals(crowd.surfaces[s], *particles[s], listed, state.normals[s]);
  }
}

}  // namespace

CrowdState make_crowd_state(const SurfaceCrowd& crowd) {
  CrowdState state;
  for (std::size_t s = 0; s < crowd.surfaces.size(); ++s)
    state.trees.emplace_back(TriangleMesh{crowd.rest[s].cast<Real>(), crowd.surfaces[s].faces});
  state.normals = crowd.rest_normals;
  state.touches.resize(crowd.pairs.size());
  return state;
}

void find_touches(const SurfaceCrowd& crowd, const std::vector<const Particles*>& particles, CrowdState& state) {
  std::vector<Box> boxes(particles.size());
  parallel_for(static_cast<Index>(particles.size()), 1, [&](Index begin, Index end) {
    for (auto s = static_cast<std::size_t>(begin); s < static_cast<std::size_t>(end); ++s) {
      boxes[s] = box_around(*particles[s]);
      particle_normals(crowd.surfaces[s], *particles[s], state.normals[s]);
      Points points(3, particles[s]->count());
      for (Index p = 0; p < points.cols(); ++p) points.col(p) = particles[s]->position(p).cast<Real>();
      state.trees[s].refit(points);
    }
  });
  for (std::size_t i = 0; i < crowd.pairs.size(); ++i) {
    const SurfacePair& pair = crowd.pairs[i];
    PairTouches& touches = state.touches[i];
    const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
    if (pair.is_self()) {
      find_self(self_rule(crowd, state, pair.first), *particles[a], state.trees[a], crowd.settings.self_reach,
                touches.near_second);
    } else {
      const float reach = crowd.settings.reach;
      find_near(*particles[a], pair.shift, state.trees[b], boxes[b], reach, touches.near_second);
      find_near(*particles[b], -pair.shift, state.trees[a], boxes[a], reach, touches.near_first);
    }
  }
}

void follow_touches(const SurfaceCrowd& crowd, const std::vector<const Particles*>& particles, CrowdState& state) {
  refresh_normals(crowd, particles, state);
  // Cohesion also looks at what has parted.
  const float within = listed_within + (crowd.settings.cohesion > 0 ? crowd.settings.reach : 0);
  for (std::size_t i = 0; i < crowd.pairs.size(); ++i) {
    const SurfacePair& pair = crowd.pairs[i];
    PairTouches& touches = state.touches[i];
    const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
    if (pair.is_self()) {
      const SelfRule rule = self_rule(crowd, state, pair.first);
      follow(touches.near_second, crowd.surfaces[a], state.normals[a], *particles[a], *particles[a],
             Eigen::Vector3f::Zero(), listed_within, &rule, touches.on_second);
      continue;
    }
    follow(touches.near_second, crowd.surfaces[b], state.normals[b], *particles[a], *particles[b], pair.shift, within,
           nullptr, touches.on_second);
    follow(touches.near_first, crowd.surfaces[a], state.normals[a], *particles[b], *particles[a], -pair.shift, within,
           nullptr, touches.on_first);
    find_edges(crowd, pair, particles, state.normals, touches.near_second, touches.edges);
  }
}

}  // namespace gracilis
