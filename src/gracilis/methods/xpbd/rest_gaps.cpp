#include <gracilis/methods/xpbd/rest_gaps.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/contact/mesh/edge_spread.hpp>
#include <gracilis/dynamics/contact/surface/overlap_release.hpp>
#include <gracilis/methods/xpbd/preparation.hpp>

#include <algorithm>

namespace gracilis::xpbd {

namespace {

/// A sheet may become this share of its thickness at rest.
constexpr float thinnest_sheet = 0.25f;
/// What is nearer than this at rest touches, m.
constexpr float touching = 0.001f;
/// The gap of what is not kept out of the other surface, m.
constexpr float no_gap = -1;
/// By how much of the way from an attachment that stays overlapped its surroundings are taken apart.
constexpr float release_slope = 0.5f;

/// What is astray stays as deep as it is where muscles pass through each other; elsewhere what of it lies in regions
/// deeper than `reach`, m.
void mark_side(const InsideVertices& inside, const std::vector<Real>& astray, bool is_through, float reach,
               std::vector<float>& gaps, std::vector<char>& overlaps) {
  overlaps.assign(gaps.size(), 0);
  for (const Index v : inside.vertices) overlaps[static_cast<std::size_t>(v)] = 1;
  for (std::size_t v = 0; v < astray.size(); ++v) {
    if (astray[v] == 0) continue;
    if (is_through || (overlaps[v] && astray[v] > reach))
      overlaps[v] = 0;
    else
      gaps[v] = no_gap;
  }
}

void mark_depths(const RestOverlap& overlap, const Particles& first, const Particles& second, SurfacePair& pair) {
  const auto movable = [](const Particles& particles) {
    std::vector<char> can_move;
    for (Index p = 0; p < particles.count(); ++p) can_move.push_back(particles.inverse_mass(p) > 0);
    return can_move;
  };
  const Points first_rest = (positions_of(first).colwise() + pair.shift).cast<Real>(),
               second_rest = positions_of(second).cast<Real>();
  DepthsAround depths = depths_around(overlap, {first_rest, movable(first)}, {second_rest, movable(second)});
  pair.first_deepest = std::move(depths.of_first), pair.second_deepest = std::move(depths.of_second);
}

/// One side of a pair at rest.
struct RestSide {
  const Particles &probe, &target;
  const ContactSurface &probe_surface, &target_surface;
  const Eigen::Matrix3Xf& target_normals;
  Eigen::Vector3f shift;
  const std::vector<char>& overlaps;
  const std::vector<char>&probe_tied, &target_tied;  ///< particles that are tied to the other

  /// Whether the two belong where they are.
  bool grown_together(const VertexFaceCandidate& candidate) const {
    if (probe_tied[static_cast<std::size_t>(candidate.particle)]) return true;
    const auto corners = target_surface.faces.col(candidate.face);
    if (std::all_of(corners.begin(), corners.end(), [&](Index p) { return target_tied[static_cast<std::size_t>(p)]; }))
      return true;
    return !(probe.inverse_mass(candidate.particle) > 0) && !can_move(target_surface, candidate.face, target);
  }

  float distance(const VertexFaceCandidate& candidate) const {
    return candidate.side *
           point_gap(probe.position(candidate.particle) + shift, target_surface, candidate.face, target, target_normals)
               .distance;
  }
};

void measure_side(const std::vector<VertexFaceCandidate>& near, const RestSide& side, bool is_self,
                  std::vector<float>& gaps, std::vector<char>& candidates) {
  for (const VertexFaceCandidate& candidate : near) {
    const auto p = static_cast<std::size_t>(candidate.particle);
    const float rest = side.distance(candidate);
    candidates[p] = rest < touching;
    // What overlaps is released; a wrong sign at a fold is not an overlap.
    if (overlaps_at_rest(side.overlaps, candidate.particle)) continue;
    const float kept = rest < 0 && is_self  ? rest * static_cast<float>(1 - overlap_given_back)
                       : candidate.side < 0 ? rest * thinnest_sheet
                                            : rest;
    gaps[p] = std::min(gaps[p], kept);
  }
}

/// The depth at which attachments lie in attachments of the other surface, or what is tied to it lies in it, on both;
/// +infinity elsewhere.
void gather_grown_together(const std::vector<VertexFaceCandidate>& near, const RestSide& side,
                           std::vector<float>& of_probe, std::vector<float>& of_target) {
  for (const VertexFaceCandidate& candidate : near) {
    if (!side.grown_together(candidate)) continue;
    const float rest = side.distance(candidate);
    if (!(rest < 0)) continue;
    const auto lower = [rest](float& depth) { depth = std::min(depth, rest); };
    lower(of_probe[static_cast<std::size_t>(candidate.particle)]);
    for (const Index corner : side.target_surface.faces.col(candidate.face))
      lower(of_target[static_cast<std::size_t>(corner)]);
  }
}

/// Which of a surface's particles are tied to another surface.
std::vector<char> tied_to(Index guest, Index host, Index count, const std::vector<TiedSurfaces>& ties) {
  std::vector<char> tied(static_cast<std::size_t>(count), 0);
  for (const TiedSurfaces& each : ties)
    if (each.guest == guest && each.host == host)
      for (const SurfaceTie& tie : each.ties) tied[static_cast<std::size_t>(tie.particle)] = 1;
  return tied;
}

/// Lowers gaps around what has a depth: to that depth, and by `release_slope` of the way from there less.
void fade_release(const ContactSurface& surface, const Particles& rest, const std::vector<float>& depth,
                  std::vector<float>& gaps) {
  std::vector<std::pair<float, Index>> sources;
  for (std::size_t p = 0; p < depth.size(); ++p)
    if (depth[p] < gaps[p]) sources.emplace_back(depth[p], static_cast<Index>(p));
  const auto growth = [&](Index from, Index to) {
    return release_slope * (rest.position(to) - rest.position(from)).norm();
  };
  const auto gap_at = [&](Index p) -> float& { return gaps[static_cast<std::size_t>(p)]; };
  spread_along_edges(surface, sources, growth, gap_at, [&](Index p, float reached) { gap_at(p) = reached; });
}

}  // namespace

OverlapTable::OverlapTable(const std::vector<TriangleMesh>& meshes, const std::vector<std::vector<char>>& in_tendon) {
  std::vector<RestOverlap> overlaps = rest_overlaps(meshes);
  std::vector<OverlapSides> sides(overlaps.size());
  parallel_for_each(overlaps.size(), [&](std::size_t i) {
    const auto first = static_cast<std::size_t>(overlaps[i].first),
               second = static_cast<std::size_t>(overlaps[i].second);
    sides[i] = overlap_sides(overlaps[i], {meshes[first], in_tendon[first]}, {meshes[second], in_tendon[second]});
  });
  for (std::size_t i = 0; i < overlaps.size(); ++i) {
    const std::pair<Index, Index> key(overlaps[i].first, overlaps[i].second);
    entries_[key] = {std::move(overlaps[i]), std::move(sides[i])};
  }
}

const OverlapTable::Entry* OverlapTable::find(Index first, Index second) const {
  const auto at = entries_.find({first, second});
  return at == entries_.end() ? nullptr : &at->second;
}

Real OverlapTable::deepest(Index first, Index second) const {
  const Entry* entry = find(first, second);
  return entry ? entry->overlap.deepest() : 0;
}

void OverlapTable::mark(float reach, const std::vector<const Particles*>& rest, SurfacePair& pair) const {
  const Entry* entry = find(pair.first, pair.second);
  if (!entry) return;
  mark_depths(entry->overlap, *rest[static_cast<std::size_t>(pair.first)], *rest[static_cast<std::size_t>(pair.second)],
              pair);
  pair.release = std::max(least_release, static_cast<float>(entry->overlap.deepest()) / release_steps);
  const OverlapSides& sides = entry->sides;
  mark_side(entry->overlap.of_first, sides.first_astray, sides.is_through, reach, pair.first_gap, pair.first_overlaps);
  mark_side(entry->overlap.of_second, sides.second_astray, sides.is_through, reach, pair.second_gap,
            pair.second_overlaps);
  pair.first_ways = sides.first_ways.cast<float>();
  pair.second_ways = sides.second_ways.cast<float>();
}

void measure_rest_gaps(const ContactWorldState& state, const std::vector<const Particles*>& rest, std::size_t number,
                       const std::vector<TiedSurfaces>& ties, ContactWorld& world) {
  SurfacePair& pair = world.pairs[number];
  const PairCandidates& candidates = state.candidates[number];
  const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
  const std::vector<char> first_tied = tied_to(pair.first, pair.second, rest[a]->count(), ties),
                          second_tied = tied_to(pair.second, pair.first, rest[b]->count(), ties);
  const RestSide first{*rest[a],         *rest[b],   world.surfaces[a],   world.surfaces[b],
                       state.normals[b], pair.shift, pair.first_overlaps, first_tied,
                       second_tied},
      second{*rest[b],         *rest[a],    world.surfaces[b],    world.surfaces[a],
             state.normals[a], -pair.shift, pair.second_overlaps, second_tied,
             first_tied};
  measure_side(candidates.near_second, first, pair.is_self(), pair.first_gap, pair.first_touches);
  measure_side(candidates.near_first, second, pair.is_self(), pair.second_gap, pair.second_touches);
  if (pair.is_self()) {
    pair.second_gap = pair.first_gap;
    return;
  }
  const float none = std::numeric_limits<float>::infinity();
  std::vector<float> depth_first(pair.first_gap.size(), none), depth_second(pair.second_gap.size(), none);
  gather_grown_together(candidates.near_second, first, depth_first, depth_second);
  gather_grown_together(candidates.near_first, second, depth_second, depth_first);
  fade_release(world.surfaces[a], *rest[a], depth_first, pair.first_gap);
  fade_release(world.surfaces[b], *rest[b], depth_second, pair.second_gap);
}

}  // namespace gracilis::xpbd
