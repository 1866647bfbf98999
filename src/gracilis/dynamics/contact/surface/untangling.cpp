#include <gracilis/dynamics/contact/surface/untangling.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/dynamics/contact/self/unfolding.hpp>

#include <algorithm>
#include <span>
#include <utility>

namespace gracilis {

namespace {

/// How far a particle goes at once to be untangled, in neighborhoods (of some edges each).
constexpr float untangled_within = 0.5f;
/// Where no more pairs of faces than these still cut each other, as when a needle turns over, they go back to the shape
/// that they had at rest; a tangle of more is relaxed, so many times over. Fewer leave more of it, more take the
/// surface so far from its shape that it folds again in the next steps.
constexpr std::size_t few = 3;
constexpr int relaxing_rounds = 4;
/// A tangle of no more pairs of faces than these goes back to where the surface was predicted, as its surroundings did,
/// and so does what resists twice: its motion since then is smoothed, so many times over.
constexpr std::size_t small = 8;
constexpr int smoothing_rounds = 64;

/// The faces that may cut each other: where the surface is folded, and where parts of it meet.
std::vector<Index> suspects(const ContactSurface& surface, const PairCandidates& candidates,
                            const Particles& particles) {
  std::vector<Index> faces;
  gather_folded(surface, particles, faces);
  for (const VertexFaceCandidate& candidate : candidates.on_second) {
    const std::span<const Index> around = surface.vertex_faces.around(candidate.particle);
    faces.insert(faces.end(), around.begin(), around.end());
    faces.push_back(candidate.face);
  }
  for (const EdgeEdgeCandidate& candidate : candidates.edges)
    for (const Index edge : {candidate.first, candidate.second})
      for (const Index face : surface.edges[static_cast<std::size_t>(edge)].faces)
        if (face >= 0) faces.push_back(face);
  return faces;
}

/// Whether a particle that is among `near` (ascending) is behind the face that it is near to.
bool is_inside(const std::vector<VertexFaceCandidate>& near, Index particle) {
  const auto found =
      std::lower_bound(near.begin(), near.end(), particle,
                       [](const VertexFaceCandidate& each, Index wanted) { return each.particle < wanted; });
  return found != near.end() && found->particle == particle && found->distance < 0;
}

/// Whether a particle lay in another surface at rest and still does.
bool is_on_its_way_out(const ContactWorld& world, const ContactWorldState& state, std::size_t surface, Index particle) {
  const auto is_in = [&](const std::vector<char>& lay_in, const std::vector<VertexFaceCandidate>& near) {
    return overlaps_at_rest(lay_in, particle) && is_inside(near, particle);
  };
  for (std::size_t i = 0; i < world.pairs.size(); ++i) {
    const SurfacePair& pair = world.pairs[i];
    const PairCandidates& candidates = state.candidates[i];
    if (static_cast<std::size_t>(pair.first) == surface && is_in(pair.first_overlaps, candidates.near_second))
      return true;
    if (static_cast<std::size_t>(pair.second) == surface && is_in(pair.second_overlaps, candidates.near_first))
      return true;
  }
  return false;
}

/// Those on the way out of another surface in which they lay at rest: what is still in and what is out already folds
/// between them. Contact lets go of it; it goes out later.
std::vector<FacePair> let_go_of_overlaps(const ContactWorld& world, const ContactWorldState& state, std::size_t surface,
                                         std::vector<FacePair> folds, std::vector<char>& torn) {
  std::erase_if(folds, [&](const FacePair& fold) {
    bool overlaps = false;
    for (const Index face : fold)
      for (const Index corner : world.surfaces[surface].faces.col(face))
        if (is_on_its_way_out(world, state, surface, corner))
          torn[static_cast<std::size_t>(corner)] = 1, overlaps = true;
    return !overlaps;
  });
  return folds;
}

}  // namespace

bool is_less(const Tangle& one, const Tangle& other) {
  return std::pair(one.cuts, one.pairs.size()) < std::pair(other.cuts, other.pairs.size());
}

std::vector<Tangle> find_tangles(const ContactWorld& world, ContactWorldState& state,
                                 const std::vector<const Particles*>& particles, const Movers& movers) {
  std::vector<Tangle> tangles(world.surfaces.size());
  parallel_for_each(world.pairs.size(), [&](std::size_t i) {
    const auto at = static_cast<std::size_t>(world.pairs[i].first);
    if (!world.pairs[i].is_self() || !movers.move(at)) return;
    const ContactSurface& surface = world.surfaces[at];
    Tangle& tangle = tangles[at];
    tangle.pairs = find_self_intersections(surface, world.rest[at], state.before[at], *particles[at],
                                           suspects(surface, state.candidates[i], *particles[at]));
    tangle.cuts = tangle.pairs.size();
    std::vector<FacePair> folds = find_folds(surface, world.rest[at], state.before[at], *particles[at]);
    const std::vector<FacePair> overlapping = let_go_of_overlaps(world, state, at, folds, state.torn[at]);
    if (tangle.cuts > 0) folds = overlapping;
    tangle.pairs.insert(tangle.pairs.end(), folds.begin(), folds.end());
  });
  return tangles;
}

void untangle(const ContactWorld& world, const std::vector<Tangle>& tangles, int attempt,
              const std::vector<Particles>& predicted, const std::vector<Particles*>& particles) {
  parallel_for_each(tangles.size(), [&](std::size_t at) {
    const std::vector<FacePair>& pairs = tangles[at].pairs;
    if (pairs.empty()) return;
    const ContactSurface& surface = world.surfaces[at];
    const float most = untangled_within * world.neighborhood[at];
    if (attempt == 0 ? pairs.size() <= small : attempt > 1)
      smooth_motion(surface, predicted[at], pairs, smoothing_rounds, most, *particles[at]);
    else if (pairs.size() <= few)
      unfold(surface, world.rest[at], pairs, most, *particles[at]);
    else if (attempt == 0)
      smooth(surface, pairs, relaxing_rounds, most, *particles[at]);
    else
      restore_shape(surface, world.rest[at], pairs, relaxing_rounds, most, *particles[at]);
  });
}

}  // namespace gracilis
